//! What does a JSON file of points say?

use super::super::bad_file::{BadFile, Kind, Place};
use super::Told;
use serde_json::Value;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Told>, BadFile> {
    let value: Value = serde_json::from_slice(bytes).map_err(|error| {
        let help = "check quotes, commas and brackets";
        BadFile::new(Kind::Syntax, Place::Line(error.line()), format!("this is not JSON: {error}"), help)
    })?;
    match &value {
        Value::Array(list) if list.iter().any(Value::is_object) => list.iter().map(polygon).collect(),
        other => Ok(vec![polygon(other)?]),
    }
}

fn polygon(value: &Value) -> Result<Told, BadFile> {
    let wrong = |message: &str| {
        let help = "write {\"points\": [[0, 0], [1, 2]], \"closed\": false}, or a list of points";
        BadFile::new(Kind::Syntax, Place::Whole, message, help)
    };
    let (points, closed) = match value {
        Value::Array(points) => (points, false),
        Value::Object(object) => {
            let points = object.get("points").and_then(Value::as_array);
            let closed = match object.get("closed") {
                None => false,
                Some(closed) => closed.as_bool().ok_or_else(|| wrong("`closed` is neither true nor false"))?,
            };
            (points.ok_or_else(|| wrong("an object has no list `points`"))?, closed)
        }
        _ => return Err(wrong("neither a list of points nor an object")),
    };
    let mut told = Told { closed, ..Told::default() };
    for (index, point) in points.iter().enumerate() {
        let values = point.as_array().map(|list| list.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>());
        let message = || wrong(&format!("point {index} (counted from 0) is not a list of numbers"));
        told.push(&values.flatten().ok_or_else(message)?, &Place::Whole)?;
    }
    Ok(told)
}
