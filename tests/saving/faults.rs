//! Files that are no scenes.

use raysect::prelude::*;

use crate::{read, refusal, text_of};

fn small() -> String {
    let mut world = World::new();
    let frame = world.add(Node::group().name("frame")).unwrap();
    let ball = Sphere::new(0.5).unwrap().material(Lambert::new(0.25));
    world.add(ball.parent(frame).name("ball").meta("channel", 7_u32)).unwrap();
    text_of(&world)
}

/// Why the small scene is refused with one piece of its text replaced.
#[track_caller]
fn refused(old: &str, new: &str) -> String {
    let text = small();
    assert_eq!(text.matches(old).count(), 1, "{old} in {text}");
    refusal(&text.replace(old, new))
}

#[track_caller]
fn says(message: &str, parts: &[&str]) {
    assert!(parts.iter().all(|part| message.contains(part)), "{message}\nwithout one of {parts:?}");
}

#[test]
fn the_small_scene_is_readable() {
    let expected = r#"{
"format": "raysect scene",
"version": 1,
"name": "world",
"acceleration": "Automatic",
"objects": [
  {"id": 0, "role": "shape", "kind": "Sphere", "radius": 0.5},
  {"id": 1, "role": "function", "kind": "Constant", "value": 0.25},
  {"id": 2, "role": "material", "kind": "Lambert", "reflectivity": 1}
],
"nodes": [
  {"id": 1, "kind": "group", "name": "frame", "transform": [[1.0,0.0,0.0,0.0],[0.0,1.0,0.0,0.0],[0.0,0.0,1.0,0.0]]},
  {"id": 2, "kind": "shape", "name": "ball", "parent": 1, "transform": [[1.0,0.0,0.0,0.0],[0.0,1.0,0.0,0.0],[0.0,0.0,1.0,0.0]], "shape": 0, "material": 2, "meta": {"channel":{"u32":7}}}
],
"settings": {}
}
"#;
    assert_eq!(small(), expected);
    let world = read(expected).unwrap().world;
    let ball = world.find("ball").unwrap();
    assert_eq!(world.parent(ball).unwrap(), world.find("frame"));
    assert_eq!(world.meta::<u32>(ball, "channel").unwrap(), Some(&7));
}

#[test]
fn other_formats_and_versions_are_refused() {
    says(&refused("\"raysect scene\"", "\"raysect frame\""), &["'raysect frame'", "'raysect scene'"]);
    says(&refused("\"version\": 1", "\"version\": 2"), &["version 2", "version 1"]);
    says(&refused("\"version\": 1,\n", ""), &["field 'version' is missing"]);
    says(&refused("\"settings\"", "\"setings\""), &["field 'settings' is missing"]);
    says(
        &refused("\"name\": \"world\",", "\"name\": \"world\", \"nmae\": 1,"),
        &["field 'nmae' has no meaning"],
    );
    says(&refusal("[]"), &["an object belongs here, not a list"]);
    says(&refusal(""), &["line 1, column 0"]);
    says(&refused("\"format\":", "\"format\""), &["line 2"]);
    says(&refused("\"Automatic\"", "\"Magic\""), &["'Magic'", "Automatic, List, Tree"]);
}

#[test]
fn objects_that_make_no_sense_are_named() {
    says(
        &refused("\"Sphere\"", "\"Ball\""),
        &["objects[0] with id 0, Ball", "no shape of the kind 'Ball'", "Sphere"],
    );
    says(
        &refused("\"role\": \"shape\"", "\"role\": \"sound\""),
        &["objects[0]", "no sound of the kind", "none"],
    );
    says(
        &refused("\"radius\": 0.5", "\"radius\": -0.5"),
        &["objects[0] with id 0, Sphere", "radius = -0.5 m"],
    );
    says(&refused("\"radius\": 0.5", "\"radius\": \"x\""), &["'radius' must be a number, not a text"]);
    says(&refused("\"radius\": 0.5", "\"radius\": null"), &["'radius' must be a number, not null"]);
    says(&refused("\"radius\": 0.5", "\"radius\": 1e999"), &["line 7", "number out of range"]);
    says(&refused("\"radius\": 0.5", "\"radius\": NaN"), &["line 7"]);
    says(
        &refused("\"radius\": 0.5", "\"radius\": 0.5, \"radius\": 0.6"),
        &["line 7", "'radius' stands there twice"],
    );
    says(&refused("\"radius\": 0.5", "\"radius\": 0.5, \"r\": 1"), &["objects[0]", "'r' has no meaning"]);
    says(&refused(", \"radius\": 0.5", ""), &["objects[0]", "'radius' is missing"]);
    says(
        &refused("{\"id\": 1, \"role\"", "{\"id\": 0, \"role\""),
        &["objects[1] with id 0", "has the number 0, too"],
    );
    // To itself, to one behind, to none, to one of another role.
    says(
        &refused("\"reflectivity\": 1", "\"reflectivity\": 2"),
        &["objects[2] with id 2, Lambert", "object 2"],
    );
    says(&refused("\"reflectivity\": 1", "\"reflectivity\": 0"), &["object 0, which is no function"]);
    says(&refused("\"material\": 2", "\"material\": 9"), &["nodes[1] with id 2, shape 'ball'", "object 9"]);
    says(&refused("\"shape\": 0", "\"shape\": 2"), &["nodes[1]", "object 2, which is no shape"]);
}

#[test]
fn nodes_that_make_no_tree_are_named() {
    says(
        &refused("\"parent\": 1", "\"parent\": 2"),
        &["nodes[1] with id 2", "node 2, which does not stand before"],
    );
    says(&refused("\"parent\": 1", "\"parent\": 77"), &["node 77, which does not stand before"]);
    let cycle = refused("\"name\": \"frame\"", "\"name\": \"frame\", \"parent\": 2");
    says(&cycle, &["nodes[0] with id 1, group 'frame'", "node 2, which does not stand before"]);
    says(&refused("{\"id\": 2, \"kind\"", "{\"id\": 1, \"kind\""), &["nodes[1] with id 1", "number 1, too"]);
    says(&refused("{\"id\": 1, \"kind\"", "{\"id\": 0, \"kind\""), &["nodes[0] with id 0", "number 0, too"]);
    says(&refused("\"group\"", "\"grape\""), &["nodes[0]", "'grape', not one of: group, observer, shape"]);
    says(&refused("\"kind\": \"shape\"", "\"kind\": \"observer\""), &["nodes[1]", "has no meaning"]);
    says(&refused(", \"shape\": 0", ""), &["nodes[1]", "'shape' is missing"]);
    let flat = small().replacen("[0.0,1.0,0.0,0.0]", "[2.0,0.0,0.0,0.0]", 1);
    says(&refusal(&flat), &["nodes[0]", "has no inverse"]);
    let short = small().replacen("[0.0,1.0,0.0,0.0]", "[1.0,0.0,0.0]", 1);
    says(&refusal(&short), &["'transform' must be three rows of four numbers"]);
    says(&refused("{\"u32\":7}", "{\"u32\":-7}"), &["nodes[1]", "'channel'"]);
    says(&refused("{\"u32\":7}", "{\"list\":7}"), &["nodes[1]", "'channel'"]);
}

#[test]
fn numbers_may_have_gaps() {
    let text = small().replace("{\"id\": 1, \"role\"", "{\"id\": 41, \"role\"");
    assert_eq!(
        text_of(&read(&text.replace("\"reflectivity\": 1", "\"reflectivity\": 41")).unwrap().world),
        small()
    );
}
