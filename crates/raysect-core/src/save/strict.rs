//! JSON without keys that stand twice.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

use super::SaveError;

/// The value of a text.
pub(super) fn parse(text: &str) -> Result<Value, SaveError> {
    let parsed: Result<Strict, serde_json::Error> = serde_json::from_str(text);
    parsed.map(|strict| strict.0).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        let what = error.to_string().replace(&format!(" at line {line} column {column}"), "");
        SaveError::Syntax { line, column, what }
    })
}

/// A value of which each object has each key once: of two, one would be lost without a word.
struct Strict(Value);

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(StrictVisitor)
    }
}

struct StrictVisitor;

impl<'de> Visitor<'de> for StrictVisitor {
    type Value = Strict;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }
    fn visit_unit<E>(self) -> Result<Strict, E> {
        Ok(Strict(Value::Null))
    }
    fn visit_bool<E>(self, value: bool) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }
    fn visit_i64<E>(self, value: i64) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }
    fn visit_u64<E>(self, value: u64) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }
    fn visit_f64<E>(self, value: f64) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }
    fn visit_str<E>(self, value: &str) -> Result<Strict, E> {
        Ok(Strict(value.into()))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Strict, A::Error> {
        let mut list = Vec::new();
        while let Some(Strict(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(Strict(Value::Array(list)))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Strict, A::Error> {
        let mut map = Map::new();
        while let Some((key, Strict(value))) = entries.next_entry::<String, Strict>()? {
            if map.contains_key(&key) {
                return Err(A::Error::custom(format!("the key '{key}' stands there twice")));
            }
            map.insert(key, value);
        }
        Ok(Strict(Value::Object(map)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_named_with_their_line() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        let twice = message("{\n\"a\": 1,\n\"a\": 2}");
        assert!(
            twice.starts_with("line 3, ") && twice.ends_with("the key 'a' stands there twice"),
            "{twice}"
        );
        assert!(message("[1,\n2").starts_with("line 2, column 1: EOF"), "{}", message("[1,\n2"));
        assert!(message("[1e999]").contains("number out of range"));
        assert!(message("[NaN]").starts_with("line 1"));
        assert!(message(&"[".repeat(100_000)).contains("recursion limit"));
        assert!(message("{} {}").contains("trailing"));
    }

    #[test]
    fn numbers_come_back_with_every_bit() {
        let mut rng = raysect_math::Rng::new(5);
        let random = std::iter::repeat_with(|| rng.range(-1.0, 1.0) * 10f64.powf(rng.range(-320.0, 308.0)));
        let special = [0.1, -0.0, 5e-324, f64::MAX, 1.0 / 3.0, f64::MIN_POSITIVE.next_down()];
        for x in special.into_iter().chain(random.take(10_000)) {
            let text = Value::from(x).to_string();
            assert_eq!(parse(&text).unwrap().as_f64().unwrap().to_bits(), x.to_bits(), "{text}");
        }
    }
}
