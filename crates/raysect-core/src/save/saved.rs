use raysect_math::AffineMatrix3D;
use serde_json::Value;

use super::{Reference, SaveError};

/// What a file says of one object: its kind and its fields.
///
/// ```
/// use raysect_core::save::Saved;
/// let ball = Saved::new("Ball").number("radius", 0.5).flag("hollow", false);
/// ```
///
/// Numbers are finite and come back with every bit. The names `id`, `role` and `kind` are taken.
#[derive(Debug)]
pub struct Saved {
    kind: String,
    fields: Vec<(String, Value)>,
    /// The first number that is not finite.
    refused: Option<(String, f64)>,
    /// The object that stands in the file already, if it does.
    pub(super) known: Option<u64>,
    /// Where the object lies in memory: others that refer there mean the same object.
    pub(super) addresses: Vec<usize>,
}

impl Saved {
    /// Of a kind, by which the registry knows how to read it.
    pub fn new(kind: impl Into<String>) -> Self {
        let (fields, addresses) = (Vec::new(), Vec::new());
        Self { kind: kind.into(), fields, refused: None, known: None, addresses }
    }

    /// An object that stands in the file already.
    pub(super) fn again(id: u64) -> Self {
        Self { known: Some(id), ..Self::new("") }
    }

    /// With a number.
    pub fn number(mut self, name: &str, value: f64) -> Self {
        let value = self.checked(name, value);
        self.field(name, value)
    }

    /// With a list of numbers.
    pub fn numbers(mut self, name: &str, values: &[f64]) -> Self {
        let values = values.iter().map(|&value| self.checked(name, value)).collect();
        self.field(name, Value::Array(values))
    }

    /// With a number of things, or a seed.
    pub fn count(self, name: &str, value: u64) -> Self {
        self.field(name, value.into())
    }

    /// With an integer.
    pub fn integer(self, name: &str, value: i64) -> Self {
        self.field(name, value.into())
    }

    /// With a yes or no.
    pub fn flag(self, name: &str, value: bool) -> Self {
        self.field(name, value.into())
    }

    /// With a text.
    pub fn text(self, name: &str, value: impl Into<String>) -> Self {
        self.field(name, Value::String(value.into()))
    }

    /// With an affine map, as the three rows of its matrix above (0, 0, 0, 1).
    pub fn transform(mut self, name: &str, map: &AffineMatrix3D) -> Self {
        let [x, y, z, _] = map.to_rows();
        let rows = [x, y, z].map(|row| Value::Array(row.map(|value| self.checked(name, value)).into()));
        self.field(name, Value::Array(rows.into()))
    }

    /// With another object or a node, by the reference that the [`SceneWriter`](super::SceneWriter) gave.
    pub fn reference(self, name: &str, reference: Reference) -> Self {
        self.field(name, reference.0.into())
    }

    pub(crate) fn field(mut self, name: &str, value: Value) -> Self {
        self.fields.push((name.to_owned(), value));
        self
    }

    fn checked(&mut self, name: &str, value: f64) -> Value {
        if !value.is_finite() && self.refused.is_none() {
            self.refused = Some((name.to_owned(), value));
        }
        value.into()
    }

    /// The inner text of its JSON object.
    pub(super) fn body(&self, role: Option<&'static str>) -> Result<String, SaveError> {
        let kind = self.kind.clone();
        if let Some((field, value)) = self.refused.clone() {
            return Err(SaveError::NotFinite { kind, field, value });
        }
        let mut body = String::new();
        if let Some(role) = role {
            body = format!("\"role\": {}, ", Value::from(role));
        }
        body += &format!("\"kind\": {}", Value::from(kind));
        for (i, (name, value)) in self.fields.iter().enumerate() {
            let taken = ["id", "role", "kind"].contains(&name.as_str());
            if taken || self.fields[..i].iter().any(|(other, _)| other == name) {
                return Err(SaveError::NoPlace(format!("{} with the field '{name}' twice", self.kind)));
            }
            body += &format!(", {}: {value}", Value::from(name.as_str()));
        }
        Ok(body)
    }

    pub(super) fn is_bare(&self) -> bool {
        self.fields.is_empty()
    }
}
