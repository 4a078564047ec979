//! A program that is killed loses no more than the pass in progress.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use raysect::math::Rng;
use raysect::prelude::*;

use crate::bits::{CASES, COUNT, Case, Pictures, counts};
use crate::folder::Folder;

const CASE: Case = CASES[2];
/// How the child knows where its file is.
const VARIABLE: &str = "RAYSECT_TEST_STATEPOINT";
const KILLS: usize = 20;

fn camera(path: &Path) -> PinholeCamera {
    CASE.camera(3).threads(2).unwrap().statepoint(path)
}

/// Goes on from the file until it is killed, and says after each pass how many samples are safe.
#[test]
#[ignore = "it is the program that the other test kills"]
fn the_program_that_is_killed() {
    let Some(path) = std::env::var_os(VARIABLE) else { return };
    let (world, camera, mut pictures) = (CASE.world(), camera(path.as_ref()), Pictures::default());
    camera.resume(&world, &mut pictures.both()).unwrap();
    println!("began {}", pictures.rgb.frame().samples(0));
    for _ in 0..100_000 {
        pictures.observe(&camera, &world);
        println!("safe {}", pictures.rgb.frame().samples(0));
    }
}

fn start(path: &Path) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "killing::the_program_that_is_killed", "--ignored", "--nocapture"])
        .env(VARIABLE, path)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// The last number that was printed after a word.
fn last(lines: &[String], word: &str) -> Option<u64> {
    let numbers = lines.iter().filter_map(|line| line.split_once(word));
    numbers.filter_map(|(_, number)| number.trim().parse().ok()).next_back()
}

/// Kills a program some time after its first pass; what it has said before.
fn killed(path: &Path, after: Duration) -> Vec<String> {
    let mut child = start(path);
    let mut reader = BufReader::new(child.stdout.take().unwrap());
    let mut lines = Vec::new();
    let mut line = String::new();
    while !line.contains("began ") {
        line.clear();
        assert!(reader.read_line(&mut line).unwrap() > 0, "the program has not begun: {lines:?}");
        lines.push(line.clone());
    }
    std::thread::sleep(after);
    child.kill().unwrap();
    child.wait().unwrap();
    // A last line may have been cut short: it has no end then.
    let rest: Vec<u8> = std::io::Read::bytes(reader).map_while(Result::ok).collect();
    let text = String::from_utf8_lossy(&rest);
    lines.extend(text.split_inclusive('\n').filter(|line| line.ends_with('\n')).map(str::to_owned));
    lines
}

#[test]
fn twenty_programs_killed_at_random_moments_make_one_undisturbed_observation() {
    let folder = Folder::new("killing");
    let path = folder.join("state");
    let world = CASE.world();
    let (mut rng, mut safe, mut worked) = (Rng::new(20), 0, 0);
    for kill in 0..KILLS {
        let lines = killed(&path, Duration::from_secs_f64(0.06 * rng.uniform()));
        let began = last(&lines, "began ").unwrap();
        assert!(began >= safe, "kill {kill}: {safe} samples were safe, and {began} have been found");
        worked += usize::from(last(&lines, "safe ").is_some());
        safe = last(&lines, "safe ").unwrap_or(began);
    }
    assert!(worked >= KILLS / 4, "{worked} of {KILLS} programs had time for a pass");
    let mut pictures = Pictures::default();
    assert!(camera(&path).resume(&world, &mut pictures.both()).unwrap());
    let samples = pictures.rgb.frame().samples(0);
    assert!(samples >= safe && counts(pictures.rgb.frame()) == [samples; COUNT]);
    assert!(pictures.bits() == Pictures::of(&CASE.camera(samples).threads(2).unwrap(), &world));
    // Nothing else lies around but what was being written when a program was killed.
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert!(left <= 1 + KILLS, "{left} files");
}
