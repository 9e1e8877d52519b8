//! How does the report of a curve or a grid become texts?
//!
//! A document is made of an introduction, tables and pictures; Markdown and LaTeX print it as they print that of a surface.

use super::NoCurveReport;
use super::model::CurveReport;
use super::tables::{introduction, tables};
use super::terminal::terminal;
use crate::report::markdown::Parts;
use crate::report::model::Reference;
use crate::report::{Figure, Picture, Table};

/// A report in every form.
#[derive(Clone, Debug)]
pub struct Document {
    /// The scheme's short name.
    pub scheme: String,
    /// What it is called.
    pub title: String,
    /// What was analysed, in a paragraph.
    pub introduction: String,
    /// Its tables.
    pub tables: Vec<Table>,
    /// What it refers to.
    pub sources: Vec<Reference>,
    /// Its pictures.
    pub pictures: Vec<Picture>,
    /// The summary for a terminal.
    pub terminal: String,
    /// The JSON form.
    pub json: String,
}

impl Document {
    fn figures(&self) -> Vec<Figure> {
        let belongs_to = |name| match name {
            "limit-function" => super::tables::DERIVATIVES,
            "curve" => super::tables::CONVERGENCE,
            _ => "",
        };
        let figure = |picture: &Picture| Figure {
            name: picture.name.to_string(),
            caption: picture.caption.clone(),
            belongs_to: belongs_to(picture.name),
        };
        self.pictures.iter().map(figure).collect()
    }

    fn parts<'a>(&'a self, figures: &'a [Figure]) -> Parts<'a> {
        Parts {
            title: &self.title,
            introduction: &self.introduction,
            tables: &self.tables,
            figures,
            sources: &self.sources,
        }
    }

    /// In Markdown; with links to the pictures, if there are any.
    pub fn markdown(&self) -> String {
        self.parts(&self.figures()).markdown("")
    }

    /// In LaTeX.
    pub fn latex(&self) -> String {
        self.parts(&self.figures()).latex()
    }

    /// As one CSV table: the title of the table, its row, its column, the text of the cell.
    pub fn csv(&self) -> String {
        let quoted = crate::report::csv::quoted;
        let mut text = "table,row,column,value\n".to_string();
        for table in &self.tables {
            for (number, row) in table.rows.iter().enumerate() {
                for (head, cell) in table.head.iter().zip(row) {
                    let (title, head) = (quoted(&table.title), quoted(head));
                    text.push_str(&format!("{title},{number},{head},{}\n", quoted(&cell.text)));
                }
            }
        }
        text
    }

    /// All of these as (file name, text).
    pub fn texts(&self) -> Vec<(String, String)> {
        let name = |ending: &str| format!("{}.{ending}", self.scheme);
        vec![
            (name("md"), self.markdown()),
            (name("tex"), self.latex()),
            (name("csv"), self.csv()),
            (name("json"), self.json.clone()),
        ]
    }
}

pub(super) fn of_curve(report: &CurveReport, pictures: Vec<Picture>) -> Result<Document, NoCurveReport> {
    let json = serde_json::to_string_pretty(report).map_err(|error| NoCurveReport::Words(error.to_string()))?;
    Ok(Document {
        scheme: report.scheme.clone(),
        title: report.title.clone(),
        introduction: introduction(report),
        tables: tables(report),
        sources: report.sources.clone(),
        pictures,
        terminal: terminal(report),
        json: json + "\n",
    })
}
