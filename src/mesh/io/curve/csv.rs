//! What does a CSV file of points say?
//!
//! Numbers with commas, semicolons or blanks between them; a first line of words is a head; an empty line starts another polygon.

use super::super::bad_file::{BadFile, Kind, Place, shown};
use super::super::text::Lines;
use super::Told;

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Told>, BadFile> {
    let mut all: Vec<Told> = Vec::new();
    let mut own = Told::default();
    let mut first = true;
    for line in Lines::new(bytes) {
        let text = String::from_utf8_lossy(&line.text).into_owned();
        let text = text.split('#').next().unwrap_or_default().trim();
        let words: Vec<&str> =
            text.split([',', ';', '\t', ' ']).map(str::trim).filter(|word| !word.is_empty()).collect();
        if words.is_empty() {
            // a line of nothing but a comment does not part polygons
            if line.text.trim_ascii().is_empty() && !own.points.is_empty() {
                all.push(std::mem::take(&mut own));
            }
            continue;
        }
        let values: Result<Vec<f64>, &str> = words.iter().map(|word| word.parse::<f64>().map_err(|_| *word)).collect();
        match values {
            Ok(values) => own.push(&values, &line.place())?,
            Err(_) if first && words.iter().all(|word| word.parse::<f64>().is_err()) => {}
            Err(word) => {
                let message = format!("{} is not a number", shown(word.as_bytes()));
                let help = "give x and y on one line, with a comma between them and points in numbers";
                return Err(BadFile::new(Kind::Number, Place::Line(line.number), message, help));
            }
        }
        first = false;
    }
    if !own.points.is_empty() {
        all.push(own);
    }
    Ok(all)
}
