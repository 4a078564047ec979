use std::any::Any;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use raysect_math::AffineMatrix3D;
use serde_json::{Map, Value};

use super::{SaveError, SceneObject};
use crate::NodeId;

/// What has been made of a file so far, by the numbers in the file.
#[derive(Default)]
pub(super) struct Made {
    /// Each an `Arc<T>` of the object's role.
    pub(super) objects: BTreeMap<u64, Box<dyn Any + Send + Sync>>,
    pub(super) nodes: BTreeMap<u64, NodeId>,
}

/// The fields of one object in a file, to make it of.
///
/// Each question names a field, and is answered with [`SaveError`] if the field is missing or of another type. A field
/// that nobody has asked for is an error in the end.
pub struct Entry<'a> {
    fields: &'a Map<String, Value>,
    asked: RefCell<BTreeSet<&'a str>>,
    made: &'a Made,
}

impl std::fmt::Debug for Entry<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Entry({:?})", self.fields)
    }
}

/// What a value is, for messages.
fn kind_of(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a flag",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

fn wrong(name: &str, wanted: &str, found: &Value) -> SaveError {
    SaveError::content(format!("field '{name}' must be {wanted}, not {}", kind_of(found)))
}

impl<'a> Entry<'a> {
    pub(super) fn new(fields: &'a Map<String, Value>, made: &'a Made) -> Self {
        Self { fields, asked: RefCell::default(), made }
    }

    /// Of any JSON value, which must be an object.
    pub(super) fn of(value: &'a Value, made: &'a Made) -> Result<Self, SaveError> {
        match value {
            Value::Object(fields) => Ok(Self::new(fields, made)),
            other => Err(SaveError::content(format!("an object belongs here, not {}", kind_of(other)))),
        }
    }

    /// Refuses fields that nobody has asked for.
    pub(super) fn finish(&self) -> Result<(), SaveError> {
        let asked = self.asked.borrow();
        match self.fields.keys().find(|name| !asked.contains(name.as_str())) {
            Some(name) => Err(SaveError::content(format!("field '{name}' has no meaning here"))),
            None => Ok(()),
        }
    }

    pub(super) fn optional(&self, name: &str) -> Option<&'a Value> {
        let (name, value) = self.fields.get_key_value(name)?;
        self.asked.borrow_mut().insert(name);
        Some(value)
    }

    fn value(&self, name: &str) -> Result<&'a Value, SaveError> {
        self.optional(name).ok_or_else(|| SaveError::content(format!("field '{name}' is missing")))
    }

    /// True if there is such a field.
    pub fn has(&self, name: &str) -> bool {
        self.fields.contains_key(name)
    }

    /// A number.
    ///
    /// # Errors
    /// [`SaveError::Content`].
    pub fn number(&self, name: &str) -> Result<f64, SaveError> {
        let value = self.value(name)?;
        value.as_f64().ok_or_else(|| wrong(name, "a number", value))
    }

    /// A list of numbers.
    ///
    /// # Errors
    /// [`SaveError::Content`].
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, SaveError> {
        self.list(name)?
            .iter()
            .map(|v| v.as_f64().ok_or_else(|| wrong(name, "a list of numbers", v)))
            .collect()
    }

    /// A list of as many numbers as are wanted.
    ///
    /// # Errors
    /// [`SaveError::Content`].
    pub fn array<const N: usize>(&self, name: &str) -> Result<[f64; N], SaveError> {
        let numbers = self.numbers(name)?;
        let found = numbers.len();
        numbers.try_into().map_err(|_| {
            SaveError::content(format!("field '{name}' must be a list of {N} numbers, not of {found}"))
        })
    }

    /// A number of things, or a seed.
    ///
    /// # Errors
    /// [`SaveError::Content`].
    pub fn count(&self, name: &str) -> Result<u64, SaveError> {
        let value = self.value(name)?;
        value.as_u64().ok_or_else(|| wrong(name, "an integer of 0 or more, below 2⁶⁴", value))
    }

    /// An integer of the type that is wanted.
    ///
    /// # Errors
    /// [`SaveError::Content`], also if it does not fit the type.
    pub fn integer<T: TryFrom<i64>>(&self, name: &str) -> Result<T, SaveError> {
        let value = self.value(name)?;
        let fitting = value.as_i64().and_then(|i| T::try_from(i).ok());
        fitting.ok_or_else(|| wrong(name, &format!("an integer ({})", std::any::type_name::<T>()), value))
    }

    /// A yes or no.
    ///
    /// # Errors
    /// [`SaveError::Content`].
    pub fn flag(&self, name: &str) -> Result<bool, SaveError> {
        let value = self.value(name)?;
        value.as_bool().ok_or_else(|| wrong(name, "true or false", value))
    }

    /// A text.
    ///
    /// # Errors
    /// [`SaveError::Content`].
    pub fn text(&self, name: &str) -> Result<&'a str, SaveError> {
        let value = self.value(name)?;
        value.as_str().ok_or_else(|| wrong(name, "a text", value))
    }

    /// What a text stands for, out of a list of choices.
    ///
    /// # Errors
    /// [`SaveError::Content`] for a text that is not in the list.
    pub fn choice<T: Clone>(&self, name: &str, choices: &[(&str, T)]) -> Result<T, SaveError> {
        let wanted = self.text(name)?;
        let chosen = choices.iter().find(|(text, _)| *text == wanted);
        chosen.map(|(_, choice)| choice.clone()).ok_or_else(|| {
            let known: Vec<&str> = choices.iter().map(|(text, _)| *text).collect();
            SaveError::content(format!("field '{name}' is '{wanted}', not one of: {}", known.join(", ")))
        })
    }

    /// An affine map.
    ///
    /// # Errors
    /// [`SaveError::Content`], or what the matrix is refused for.
    pub fn transform(&self, name: &str) -> Result<AffineMatrix3D, SaveError> {
        let mut rows = [[0.0, 0.0, 0.0, 1.0]; 4];
        let given = self.list(name)?;
        let misshapen = || SaveError::content(format!("field '{name}' must be three rows of four numbers"));
        if given.len() != 3 {
            return Err(misshapen());
        }
        for (row, given) in rows.iter_mut().zip(given) {
            let numbers: Option<Vec<f64>> =
                given.as_array().and_then(|row| row.iter().map(Value::as_f64).collect());
            *row = numbers.and_then(|n| n.try_into().ok()).ok_or_else(misshapen)?;
        }
        Ok(AffineMatrix3D::from_rows(rows)?)
    }

    /// Another object of the file, which must stand before this one.
    ///
    /// # Errors
    /// [`SaveError::Content`] for a number that no object before this one has, or an object of another role.
    pub fn object<T: SceneObject + ?Sized>(&self, name: &str) -> Result<Arc<T>, SaveError> {
        let id = self.count(name)?;
        let Some(object) = self.made.objects.get(&id) else {
            let what = format!("field '{name}' refers to object {id}, which does not stand before");
            return Err(SaveError::Content(what));
        };
        let fitting = object.downcast_ref::<Arc<T>>().cloned();
        fitting.ok_or_else(|| {
            SaveError::content(format!("field '{name}' refers to object {id}, which is no {}", T::ROLE))
        })
    }

    /// A node of the world.
    ///
    /// # Errors
    /// [`SaveError::Content`] for a number that no node before has.
    pub fn node(&self, name: &str) -> Result<NodeId, SaveError> {
        let id = self.count(name)?;
        self.made.nodes.get(&id).copied().ok_or_else(|| {
            SaveError::content(format!("field '{name}' refers to node {id}, which does not stand before"))
        })
    }

    pub(super) fn list(&self, name: &str) -> Result<&'a [Value], SaveError> {
        let value = self.value(name)?;
        value.as_array().map(Vec::as_slice).ok_or_else(|| wrong(name, "a list", value))
    }

    pub(crate) fn map(&self, name: &str) -> Result<&'a Map<String, Value>, SaveError> {
        let value = self.value(name)?;
        value.as_object().ok_or_else(|| wrong(name, "an object", value))
    }
}
