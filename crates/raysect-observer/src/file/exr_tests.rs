use super::super::scratch::Folder;
use super::*;
use exr::prelude::{FlatImage, read_all_flat_layers_from_file};

fn layer(name: &str, channels: &[(&str, Vec<f64>)]) -> ExrLayer {
    let channels = channels.iter().map(|(name, values)| ((*name).to_owned(), values.clone())).collect();
    ExrLayer { name: name.to_owned(), channels }
}

fn picture(layers: &[&str], size: usize) -> Vec<ExrLayer> {
    let values = |seed: usize| (0..size).map(|i| ((i * 31 + seed) % 97) as f64 / 8.0).collect::<Vec<_>>();
    let channels = |seed| [("R", values(seed)), ("G", values(seed + 1)), ("B", values(seed + 2))];
    layers.iter().enumerate().map(|(seed, name)| layer(name, &channels(10 * seed))).collect()
}

fn names(image: &FlatImage) -> Vec<String> {
    image.layer_data[0].channel_data.list.iter().map(|channel| channel.name.to_string()).collect()
}

fn values(image: &FlatImage, name: &str) -> Vec<f32> {
    let list = &image.layer_data[0].channel_data.list;
    let channel = list.iter().find(|channel| channel.name.to_string() == name).unwrap();
    channel.sample_data.values_as_f32().collect()
}

#[test]
fn layers_come_back() {
    let folder = Folder::new();
    let path = folder.join("a.exr");
    let mut layers = picture(&["", "error"], 37 * 19);
    layers.push(layer("samples", &[("Y", vec![16_777_216.0; 37 * 19])]));
    save_exr(&path, 37, 19, &layers, &BTreeMap::new()).unwrap();
    let image = read_all_flat_layers_from_file(&path).unwrap();
    assert_eq!((image.layer_data.len(), image.layer_data[0].size), (1, (37, 19).into()));
    assert_eq!(names(&image), ["B", "G", "R", "error.B", "error.G", "error.R", "samples.Y"]);
    for layer in &layers {
        for (channel, expected) in &layer.channels {
            let name = format!("{}.{channel}", layer.name);
            let found = values(&image, name.trim_start_matches('.'));
            assert!(found.iter().zip(expected).all(|(&a, &b)| f64::from(a) == b), "{name}");
        }
    }
    assert_eq!(folder.names(), ["a.exr"]);
}

#[test]
fn infinities_and_not_a_number_survive() {
    let folder = Folder::new();
    let path = folder.join("a.exr");
    let given = vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 1e39, 1e-46, 1e-40, 0.1];
    save_exr(&path, 4, 2, &[layer("x", &[("Y", given.clone())])], &BTreeMap::new()).unwrap();
    let found = values(&read_all_flat_layers_from_file(&path).unwrap(), "x.Y");
    assert!(found[0].is_nan());
    let bits = |values: &[f32]| values[1..].iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    let expected: Vec<f32> = given.iter().map(|&value| value as f32).collect();
    assert_eq!(bits(&found), bits(&expected));
    assert_eq!(found[4], f32::INFINITY);
}

#[test]
fn attributes_come_back() {
    let folder = Folder::new();
    let path = folder.join("a.exr");
    let attributes = BTreeMap::from([
        ("raysect:seed".to_owned(), ExrAttribute::Text(u64::MAX.to_string())),
        ("raysect:gain".to_owned(), ExrAttribute::Number(0.1)),
        ("raysect:an attribute with a name of many letters".to_owned(), ExrAttribute::Text("µ".to_owned())),
        ("empty".to_owned(), ExrAttribute::Text(String::new())),
    ]);
    save_exr(&path, 2, 1, &picture(&[""], 2), &attributes).unwrap();
    let image = read_all_flat_layers_from_file(&path).unwrap();
    for (name, value) in &attributes {
        assert_eq!(image.layer_data[0].attributes.other[&text(name)], attribute(value), "{name}");
    }
}

#[test]
fn equal_pictures_give_equal_bytes() {
    let folder = Folder::new();
    let note = |i: usize| (format!("raysect:note{i}"), ExrAttribute::Number(i as f64));
    let attributes: BTreeMap<_, _> = (0..20).map(note).collect();
    let mut layers = picture(&["mean", "error", "a"], 200 * 150);
    let save = |name: &str, layers: &[ExrLayer]| {
        save_exr(folder.join(name), 200, 150, layers, &attributes).unwrap();
        std::fs::read(folder.join(name)).unwrap()
    };
    let first = save("a.exr", &layers);
    layers.reverse();
    assert_eq!(first, save("b.exr", &layers));
    assert_eq!(
        read_all_flat_layers_from_file(folder.join("b.exr")).unwrap().layer_data[0].attributes.other.len(),
        20
    );
}

#[test]
fn long_names_are_marked() {
    let folder = Folder::new();
    let path = folder.join("a.exr");
    let name = "a layer whose name has more than thirty-one letters";
    save_exr(&path, 1, 1, &[layer(name, &[("Y", vec![1.0])])], &BTreeMap::new()).unwrap();
    assert_eq!(names(&read_all_flat_layers_from_file(&path).unwrap()), [format!("{name}.Y")]);
    assert_eq!(std::fs::read(&path).unwrap()[5] & LONG_NAMES_MARK, LONG_NAMES_MARK);
}

#[test]
fn refuses_what_the_format_cannot_hold() {
    let folder = Folder::new();
    let path = folder.join("a.exr");
    let save = |width, height, layers: &[ExrLayer], attribute: &str| {
        let attributes = BTreeMap::from([(attribute.to_owned(), ExrAttribute::Number(1.0))]);
        save_exr(&path, width, height, layers, &attributes).unwrap_err()
    };
    let one = picture(&["a"], 1);
    assert!(matches!(save(2, 1, &one, "x"), FileError::Shape { expected: 2, found: 1, .. }));
    let refused = |error: FileError| assert!(matches!(error, FileError::Encode { .. }), "{error}");
    refused(save(0, 1, &one, "x"));
    refused(save(1, 1 << 30, &one, "x"));
    refused(save(1, 1, &[], "x"));
    refused(save(1, 1, &picture(&["a", "a"], 1), "x"));
    refused(save(1, 1, &picture(&["a\0b"], 1), "x"));
    refused(save(1, 1, &picture(&[&"x".repeat(254)], 1), "x"));
    refused(save(1, 1, &[layer("a", &[("", vec![1.0])])], "x"));
    for attribute in ["", "a\0b", "channels", "compression", "comments", &"x".repeat(256)] {
        refused(save(1, 1, &one, attribute));
    }
    assert!(folder.names().is_empty());
}
