use std::path::Path;

use exr::prelude::{FlatImage, read_all_flat_layers_from_file};
use raysect_math::translate;
use raysect_optical::{InterpolatedSf, UniformSurfaceEmitter, WithMaterial, World};
use raysect_primitive::Sphere;

use super::*;
use crate::file::scratch::Folder;
use crate::file::{NpyData, load_npz};
use crate::{PinholeCamera, PowerPipeline, Stop};

fn surroundings() -> World {
    let mut world = World::new();
    world.add(Sphere::new(10.0).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0))).unwrap();
    world
}

/// A ball whose edge crosses pixels, with a spectrum that rises.
fn ball() -> World {
    let mut world = World::new();
    let spectrum = InterpolatedSf::new([400.0, 500.0], [0.0, 2.0]).unwrap();
    let ball = Sphere::new(1.0).unwrap().material(UniformSurfaceEmitter::new(spectrum, 1.0));
    world.add(ball.transform(translate(0.3, 0.2, 5.0))).unwrap();
    world
}

fn camera(pixels: (usize, usize)) -> PinholeCamera {
    let camera = PinholeCamera::new(pixels, 30.0).unwrap().etendue(1e-9).unwrap();
    camera.wavelengths(400.0, 500.0).spectral_bins(8).pixel_samples(100).quiet(true)
}

fn seen(pixels: (usize, usize)) -> SpectralPowerPipeline {
    let mut power = SpectralPowerPipeline::new();
    camera(pixels).observe(&ball(), &mut power).unwrap();
    power
}

#[test]
fn unit_surroundings_have_a_radiance_of_one_in_every_bin() {
    for rays in [1, 3, 8] {
        let (mut power, mut radiance) = (SpectralPowerPipeline::new(), SpectralRadiancePipeline::new());
        let camera = camera((3, 2)).spectral_rays(rays);
        camera.observe(&surroundings(), &mut (&mut power, &mut radiance)).unwrap();
        for pixel in 0..6 {
            assert_eq!(radiance.spectrum(pixel), [1.0; 8]);
            assert_eq!(radiance.errors(pixel), [0.0; 8]);
            assert_eq!(power.spectrum(pixel), [1e-9; 8]);
            assert!((radiance.total(pixel).value / 100.0 - 1.0).abs() < 1e-14);
            assert!((power.total(pixel).value / 1e-7 - 1.0).abs() < 1e-14);
            assert!((radiance.to_spectrum(pixel).unwrap().total() - 100.0).abs() < 1e-11);
        }
        assert_eq!(radiance.wavelengths()[..2], [406.25, 418.75]);
        assert_eq!((power.frame().unit(), radiance.frame().unit()), ("W/nm", "W/m²/sr/nm"));
    }
}

#[test]
fn every_bin_of_every_slice_has_its_own_place() {
    let mut radiance = SpectralRadiancePipeline::new();
    let rising = InterpolatedSf::new([400.0, 500.0], [0.0, 2.0]).unwrap();
    let mut world = World::new();
    world.add(Sphere::new(10.0).unwrap().material(UniformSurfaceEmitter::new(rising, 1.0))).unwrap();
    camera((1, 1)).spectral_rays(3).observe(&world, &mut radiance).unwrap();
    for (found, wavelength) in radiance.spectrum(0).iter().zip(radiance.wavelengths()) {
        assert!((found - (wavelength - 400.0) / 50.0).abs() < 1e-12, "{found} at {wavelength} nm");
    }
}

#[test]
fn the_error_of_the_total_is_not_that_of_independent_bins() {
    let (mut spectral, mut power) = (SpectralPowerPipeline::new(), PowerPipeline::new());
    camera((2, 2)).observe(&ball(), &mut (&mut spectral, &mut power)).unwrap();
    for pixel in 0..4 {
        let (total, errors) = (spectral.total(pixel), spectral.errors(pixel));
        assert!(total.error > 0.01 * total.value && total.value > 0.0);
        // The bins of a sample are bright or dark together: their errors add up.
        let together = 12.5 * errors.iter().sum::<f64>();
        let independent = 12.5 * errors.iter().map(|e| e * e).sum::<f64>().sqrt();
        assert!((total.error / together - 1.0).abs() < 1e-9);
        assert!(total.error > 2.0 * independent);
        let plain = power.frame().pixel(pixel, 0);
        assert!(
            (plain.value / total.value - 1.0).abs() < 1e-12 && (plain.error / total.error - 1.0).abs() < 1e-9
        );
    }
}

#[test]
fn nothing_is_told_before_the_first_observation() {
    let pipeline = SpectralPowerPipeline::new();
    assert!(matches!(pipeline.to_spectrum(0), Err(ObserverError::EmptyFrame(_))));
    assert!(pipeline.wavelengths().is_empty() && pipeline.slicing().is_none());
    let folder = Folder::new();
    for name in ["a.csv", "a.npz", "a.exr"] {
        assert!(matches!(pipeline.save(folder.join(name)), Err(ObserverError::EmptyFrame(_))), "{name}");
    }
    assert!(folder.names().is_empty());
}

#[test]
fn another_range_is_refused_until_the_frame_is_cleared() {
    let mut radiance = SpectralRadiancePipeline::new();
    camera((1, 1)).observe(&surroundings(), &mut radiance).unwrap();
    let other = camera((1, 1)).wavelengths(400.0, 600.0);
    assert!(other.observe(&surroundings(), &mut radiance).is_err());
    assert_eq!(radiance.slicing().unwrap().max_wavelength(), 500.0);
    radiance.frame_mut().clear();
    other.observe(&surroundings(), &mut radiance).unwrap();
    assert_eq!(radiance.slicing().unwrap().max_wavelength(), 600.0);
}

fn numbers(path: &Path, name: &str) -> (Vec<usize>, Vec<f64>) {
    let array = load_npz(path).unwrap().remove(name).unwrap();
    let NpyData::F64(values) = array.data else { panic!("{name} has another type") };
    (array.shape, values)
}

#[test]
fn archives_hold_rows_columns_and_bins() {
    let (folder, power) = (Folder::new(), seen((3, 2)));
    let path = folder.join("a.npz");
    power.save(&path).unwrap();
    let (shape, mean) = numbers(&path, "spectral_power_mean");
    assert_eq!(shape, [2, 3, 8]);
    let (_, error) = numbers(&path, "spectral_power_error");
    for pixel in 0..6 {
        assert_eq!(mean[8 * pixel..8 * pixel + 8], power.spectrum(pixel));
        assert_eq!(error[8 * pixel..8 * pixel + 8], power.errors(pixel));
    }
    assert_eq!(numbers(&path, "wavelengths"), (vec![8], power.wavelengths()));
    let (shape, edges) = numbers(&path, "bin_edges");
    assert_eq!((shape, edges[0], edges[8]), (vec![9], 400.0, 500.0));
    let totals: Vec<f64> = (0..6).map(|p| power.total(p).value).collect();
    assert_eq!(numbers(&path, "total_mean"), (vec![2, 3], totals));
    let all = load_npz(&path).unwrap();
    assert_eq!(all["samples"].data, NpyData::I64(vec![100; 6]));
    assert_eq!(all["unit"].data, NpyData::Text(vec!["W/nm".to_owned()]));
}

fn plane(image: &FlatImage, name: &str) -> Option<Vec<f32>> {
    let list = &image.layer_data[0].channel_data.list;
    let channel = list.iter().find(|channel| channel.name.to_string() == name)?;
    Some(channel.sample_data.values_as_f32().collect())
}

#[test]
fn pictures_follow_the_spectral_convention_of_openexr() {
    let (folder, power) = (Folder::new(), seen((3, 2)));
    let path = folder.join("a.exr");
    power.save(&path).unwrap();
    let image = read_all_flat_layers_from_file(&path).unwrap();
    assert_eq!(image.layer_data[0].size, (3, 2).into());
    for (bin, wavelength) in power.wavelengths().into_iter().enumerate() {
        // 406.25 nm is S0.406,25nm.
        let name = format!("S0.{},{:0>2}nm", wavelength.trunc(), (100.0 * wavelength.fract()).round());
        let (mean, error) = (plane(&image, &name).unwrap(), plane(&image, &format!("error.{name}")).unwrap());
        for pixel in 0..6 {
            let estimate = power.bin(pixel, bin);
            assert_eq!((mean[pixel], error[pixel]), (estimate.value as f32, estimate.error as f32), "{name}");
        }
    }
    assert_eq!(plane(&image, "S0.406.25nm"), None);
    assert_eq!(plane(&image, "total.mean").unwrap()[1], power.total(1).value as f32);
    assert_eq!(plane(&image, "samples.N").unwrap(), [100.0; 6]);
    // Between 400 and 500 nm, what there is to see is blue.
    let [red, blue] = ["R", "B"].map(|name| plane(&image, name).unwrap().iter().sum::<f32>());
    assert!(blue > 5.0 * red.abs() && blue > 0.0);
    let attributes = &image.layer_data[0].attributes.other;
    for name in ["spectralLayoutVersion", "emissiveUnits", "raysect:unit", "raysect:bin_width_nm"] {
        let there = attributes.keys().any(|key| key == name);
        assert!(there, "{name}");
    }
}

#[test]
fn tables_have_units_and_a_line_for_each_bin() {
    let folder = Folder::new();
    let path = folder.join("a.csv");
    let read = |power: &SpectralPowerPipeline| {
        power.save(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let mut lines = text.lines().map(str::to_owned);
        let title = lines.next().unwrap();
        let rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(|n| n.parse().unwrap()).collect()).collect();
        (title, rows)
    };
    let single = seen((1, 1));
    let (title, rows) = read(&single);
    assert_eq!(title, "wavelength [nm],mean [W/nm],error [W/nm]");
    let expected: Vec<Vec<f64>> = (0..8)
        .map(|bin| vec![single.wavelengths()[bin], single.bin(0, bin).value, single.bin(0, bin).error])
        .collect();
    assert_eq!(rows, expected);
    let several = seen((3, 2));
    let (title, rows) = read(&several);
    assert_eq!(title, "row,column,wavelength [nm],mean [W/nm],error [W/nm]");
    assert_eq!(rows.len(), 48);
    assert_eq!(rows[8 * 5 + 2], [1.0, 2.0, 431.25, several.bin(5, 2).value, several.bin(5, 2).error]);
}

#[test]
fn other_endings_are_refused_by_name() {
    let folder = Folder::new();
    let message = seen((1, 1)).save(folder.join("a.png")).unwrap_err().to_string();
    assert!(message.contains("a.png") && message.contains(".csv, .npz, .exr"), "{message}");
    assert!(folder.names().is_empty());
}

#[test]
fn previews_are_written_after_every_pass() {
    let folder = Folder::new();
    let names: &[&str] = if cfg!(feature = "plot") { &["a.csv", "a.svg"] } else { &["a.csv"] };
    for name in names {
        let path = folder.join(name);
        let mut power = SpectralPowerPipeline::new().preview(&path);
        camera((1, 1)).observe_until(&ball(), &mut power, Stop::samples(40)).unwrap();
        let first = std::fs::read_to_string(&path).unwrap();
        camera((1, 1)).observe_until(&ball(), &mut power, Stop::samples(400)).unwrap();
        assert_ne!(std::fs::read_to_string(&path).unwrap(), first, "{name}");
    }
    assert_eq!(folder.names(), names);
}

#[cfg(feature = "plot")]
#[test]
fn plots_show_the_pixels_that_are_asked_for() {
    let power = seen((3, 2));
    let one = power.plot(&[4]).unwrap().to_svg();
    assert!(one.contains("Spectrum of row 1, column 1") && one.contains("wavelength [nm]"));
    assert!(one.contains(" W/nm]") && one.matches("<polyline").count() == 1);
    let two = power.plot(&[4, 5]).unwrap().to_svg();
    assert!(two.contains("row 1, column 1") && two.contains("row 1, column 2"));
    assert_eq!(two.matches("<polyline").count(), 2);
    assert!(SpectralPowerPipeline::new().plot(&[0]).is_err());
}
