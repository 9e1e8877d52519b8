//! Which pictures belong to a report?
//!
//! The rules with their weights, the eigenvalues, the curvature ratios, the characteristic maps, their Jacobians, and the
//! masks: one file each. The same analyses give the same bytes on every machine.

mod axes;
mod canvas;
mod charmap;
mod curvature;
mod curve;
mod eigenvalues;
mod fan;
mod formulas;
mod jacobian;
mod labels;
mod masks;
mod png;
mod prettify;
mod stencils;
mod sweep;

pub use curve::pictures as curve_pictures;
pub use png::png;
pub use sweep::picture as sweep_picture;

use crate::analysis::{Analysis, Analyzer, MapPicture};
use crate::refine::Obstacle;

/// How many valences the pictures with one panel for each show.
const MAX_PANELS: usize = 12;

/// The outermost ring of the control nets shown.
const RINGS: i32 = 3;

/// The largest valence whose sectors can be told apart in a panel.
const MAX_SECTORS: usize = 60;

/// A picture of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Its short name, a file name without its ending.
    pub name: &'static str,
    /// What is seen, in one or two sentences.
    pub caption: String,
    /// The picture.
    pub svg: String,
}

/// A valence with what is seen of its characteristic map.
struct MapPanel<'a> {
    analysis: &'a Analysis,
    picture: Option<MapPicture>,
}

impl<'a> MapPanel<'a> {
    fn of(analyzer: &Analyzer, analysis: &'a Analysis) -> Result<Self, Obstacle> {
        let fine = analysis.valence > MAX_SECTORS;
        let picture = if fine { None } else { analyzer.picture_of_map(analysis, RINGS)? };
        Ok(MapPanel { analysis, picture })
    }

    fn is_too_fine(&self) -> bool {
        self.analysis.valence > MAX_SECTORS
    }
}

/// The pictures of a report, in its order. Without analyses there are only the rules.
///
/// # Errors
/// When a weight has no value.
pub fn pictures(analyzer: &Analyzer, analyses: &[Analysis]) -> Result<Vec<Picture>, Obstacle> {
    let mut pictures = vec![stencils::picture(analyzer)?];
    if analyses.is_empty() {
        return Ok(pictures);
    }
    let first = analyses.iter().take(MAX_PANELS);
    let maps: Vec<MapPanel> = first.map(|analysis| MapPanel::of(analyzer, analysis)).collect::<Result<_, _>>()?;
    let rest = match analyses.len() {
        count if count > MAX_PANELS => format!(" Shown are the first {MAX_PANELS} of {count} valences."),
        _ => String::new(),
    };
    pictures.push(eigenvalues::picture(analyses)?);
    pictures.push(curvature::picture(analyses)?);
    pictures.push(charmap::picture(analyzer.lattice(), &maps, &rest)?);
    pictures.push(jacobian::picture(analyzer.lattice(), &maps, &rest)?);
    pictures.push(masks::picture(analyzer.lattice(), analyses)?);
    Ok(pictures)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::catalogue;

    fn of(id: &str, valences: &[usize]) -> Vec<Picture> {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let analyzer = Analyzer::new(&scheme).unwrap();
        let analyses: Vec<Analysis> = valences.iter().map(|n| analyzer.at(*n).unwrap()).collect();
        pictures(&analyzer, &analyses).unwrap()
    }

    /// The words of a picture, one string for each.
    fn words(svg: &str) -> Vec<String> {
        let inside = |part: &str| part.split_once('>').map(|(_, text)| text.trim_matches('\n').to_string());
        let plain = |text: String| text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
        svg.split("<text").skip(1).filter_map(|part| inside(part.split("</text>").next()?)).map(plain).collect()
    }

    /// The characters that have glyphs: the segments of the font's character map (format 4).
    fn ranges_of_font() -> Vec<std::ops::RangeInclusive<u32>> {
        let font = png::FONT;
        let short = |at: usize| u32::from(u16::from_be_bytes([font[at], font[at + 1]]));
        let long = |at: usize| (short(at) << 16 | short(at + 2)) as usize;
        let records = 12..12 + 16 * short(4) as usize;
        let record = records.step_by(16).find(|at| &font[*at..at + 4] == b"cmap").unwrap();
        let cmap = long(record + 8);
        let tables = (0..short(cmap + 2) as usize).map(|number| cmap + long(cmap + 8 + 8 * number));
        let table = tables.into_iter().find(|at| short(*at) == 4).unwrap();
        let twice = short(table + 6) as usize;
        let segment = |at: usize| short(table + 16 + twice + at)..=short(table + 14 + at);
        (0..twice).step_by(2).map(segment).filter(|range| *range.end() != 0xffff).collect()
    }

    #[test]
    fn every_letter_of_every_picture_has_a_glyph() {
        let ranges = ranges_of_font();
        let has = |letter: char| ranges.iter().any(|range| range.contains(&u32::from(letter)));
        assert!(has('λ') && !has('ж'));
        for listed in catalogue::SCHEMES {
            for picture in of(listed.id, &[3, 4, 5, 6, 7]) {
                for letter in words(&picture.svg).concat().chars().chain(picture.caption.chars()) {
                    assert!(has(letter), "{} {}: no glyph for {letter:?}", listed.id, picture.name);
                }
            }
        }
    }

    #[test]
    fn two_runs_give_the_same_bytes() {
        assert_eq!(of("loop", &[3, 5, 6, 9]), of("loop", &[3, 5, 6, 9]));
    }

    #[test]
    fn one_valence_two_and_none_have_pictures() {
        for valences in [&[5][..], &[3, 40], &[6]] {
            let pictures = of("loop", valences);
            let names: Vec<&str> = pictures.iter().map(|picture| picture.name).collect();
            assert_eq!(names, ["stencils", "eigenvalues", "curvature", "characteristic-map", "jacobian", "masks"]);
            for picture in pictures {
                assert!(picture.svg.starts_with("<svg") && picture.svg.ends_with("</svg>\n"));
                assert!(!picture.svg.contains("NaN") && !picture.svg.contains("2147483647"), "{}", picture.name);
            }
        }
        assert_eq!(of("loop", &[]).len(), 1);
    }

    #[test]
    fn coordinates_are_whole_and_nothing_lies_outside() {
        for picture in of("catmull-clark", &[3, 4, 5, 6, 7, 8]) {
            let height: i32 = attribute(&picture.svg, "height").next().unwrap().parse().unwrap();
            for (names, limit) in [(["x1", "x2", "cx", "x"], canvas::WIDTH), (["y1", "y2", "cy", "y"], height)] {
                for value in names.iter().flat_map(|name| attribute(&picture.svg, name)) {
                    assert!((0..=limit).contains(&value.parse::<i32>().unwrap()), "{}: {value}", picture.name);
                }
            }
            for text in words(&picture.svg) {
                assert!(canvas::text_width(&text, canvas::SMALL) <= canvas::WIDTH, "{}: {text}", picture.name);
            }
        }
    }

    fn attribute<'a>(svg: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
        let start = format!(" {name}=\"");
        svg.split(start.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect::<Vec<_>>().into_iter()
    }

    #[test]
    fn the_rules_of_a_scheme_file_are_shown_with_its_own_formulas() {
        let stencils = of("loop", &[]).remove(0);
        let words = words(&stencils.svg);
        let count = |word: &str| words.iter().filter(|text| text.as_str() == word).count();
        assert_eq!((count("3/8"), count("1/8"), count("β"), count("1 − nβ")), (2, 2, 5, 1));
        assert_eq!(count("β = (5/8 − (3/8 + cos(2π/n)/4)²)/n"), 1);
    }

    #[test]
    fn a_picture_becomes_a_png_of_its_size() {
        let svg = canvas::draw(300, |canvas| canvas.text("λ", (10, 150), canvas::TEXT, canvas::Anchor::Left)).unwrap();
        let png = png(&svg).unwrap();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!((&png[16..20], &png[20..24]), (&1200_u32.to_be_bytes()[..], &300_u32.to_be_bytes()[..]));
        assert!(super::png("<svg").is_err());
    }
}
