//! Other numbers of bins.

use crate::comparison::Picture;
use crate::cornell::Variant;
use crate::frames::{ERROR, assert_agree, judge};
use crate::reference;

/// A small picture with a number of bins.
fn picture(bins: usize, seed: u64) -> Picture {
    reference::render(Variant::Diffuse, 16, 16, bins, seed, ERROR).unwrap()
}

/// Sum over all pixels of a channel.
fn total(picture: &Picture, channel: usize) -> f64 {
    picture.mean.iter().skip(channel).step_by(picture.channels).sum()
}

#[test]
fn more_bins_show_the_same() {
    let coarse = picture(15, 1);
    assert_agree("15 and 30 bins", &coarse, &picture(30, 2));
    // Three bins cannot hold the colours of the walls.
    assert!(!judge("15 and 3 bins", &coarse, &picture(3, 2)).holds(f64::INFINITY));
}

#[test]
fn the_same_rays_differ_by_the_width_of_the_bins_alone() {
    let (coarse, fine) = (picture(15, 1), picture(30, 1));
    for channel in 0..3 {
        let ratio = total(&coarse, channel) / total(&fine, channel);
        println!("channel {channel}: {:+.3} %", 100.0 * (ratio - 1.0));
        assert!((ratio - 1.0).abs() < 0.005, "channel {channel}: {ratio}");
    }
}
