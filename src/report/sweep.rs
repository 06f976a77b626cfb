//! What a sweep has set in each case: a column in every table, a colour and a kind of line in every figure.

use polars::prelude::{Column, StringChunked};

use super::{Analysed, palette};
use crate::plan::{Swept, SweptValue};

/// Numbers of other sizes are shown as powers of ten, as a person types them.
const PLAIN: std::ops::Range<f64> = 1e-3..1e6;

/// Lines that only tell dashes apart in a legend have this colour.
const NEUTRAL: usize = 4;

/// What colour and kind of line of a case stand for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Key {
    pub color: String,
    /// `None` where cases differ by colour alone.
    pub dash: Option<String>,
}

/// How the curves of a case look.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    pub style: usize,
    /// Where a sweep tells colours and kinds of lines apart.
    pub key: Option<Key>,
}

impl Key {
    /// The style of a line that shows the colour or the dashes of another alone.
    pub fn styles(style: usize) -> [usize; 2] {
        let [color, dash] = [style % palette::LINES.len(), style % palette::DASHES.len()];
        [palette::style(color, 0), palette::style(NEUTRAL, dash)]
    }
}

/// The swept keys of a study, as the first case that has any says them.
pub fn keys<'a>(cases: &'a [Analysed]) -> &'a [Swept] {
    let swept = cases.iter().map(|case| case.result.swept.as_slice());
    swept.into_iter().find(|swept| !swept.is_empty()).unwrap_or_default()
}

/// `length 10 nm`: the last word of its path, as in the names of cases, where no other key ends in it.
fn words(swept: &Swept, keys: &[Swept]) -> String {
    let last = |path: &str| path.rsplit('.').next().unwrap_or(path).to_owned();
    let alike = keys.iter().filter(|key| last(&key.path) == last(&swept.path)).count();
    let name = match alike {
        ..=1 => last(&swept.path),
        _ => swept.path.clone(),
    };
    format!("{name} {}", with_unit(swept))
}

/// `10 nm`
pub fn with_unit(swept: &Swept) -> String {
    let value = shown(swept);
    match swept.unit() {
        "" => value,
        unit => format!("{value} {unit}"),
    }
}

/// The value without its unit.
pub fn shown(swept: &Swept) -> String {
    match &swept.value {
        SweptValue::Number { value, .. } if *value == 0.0 || PLAIN.contains(&value.abs()) => value.to_string(),
        SweptValue::Number { value, .. } => format!("{value:e}"),
        SweptValue::Word(word) => word.clone(),
    }
}

/// The columns of a table with those of the swept keys behind that of the case.
pub fn with_keys(mut columns: Vec<Column>, cases: &[Analysed]) -> Vec<Column> {
    let Some(at) = columns.iter().position(|column| column.name() == "case") else {
        return columns;
    };
    let Ok(names) = columns[at].str().cloned() else {
        return columns;
    };
    let added = keys(cases)
        .iter()
        .enumerate()
        .map(|(index, key)| column(index, key, &names, cases));
    let added: Vec<Column> = added.collect();
    columns.splice(at + 1..at + 1, added);
    columns
}

fn column(index: usize, key: &Swept, names: &StringChunked, cases: &[Analysed]) -> Column {
    let of_case = |name: Option<&str>| {
        let case = cases.iter().find(|case| Some(case.name()) == name)?;
        case.result.swept.get(index)
    };
    let swept: Vec<Option<&Swept>> = names.iter().map(of_case).collect();
    match key.number() {
        Some(_) => {
            let values: Vec<Option<f64>> = swept.iter().map(|swept| swept.and_then(Swept::number)).collect();
            Column::new(key.column().into(), values)
        }
        None => {
            let values: Vec<Option<String>> = swept.iter().map(|swept| swept.map(shown)).collect();
            Column::new(key.column().into(), values)
        }
    }
}

/// Colour by the first key and dashes by the others of a sweep; otherwise each case has its own.
pub fn looks(cases: &[Analysed]) -> Vec<Look> {
    let labels: Vec<Vec<String>> = cases.iter().map(|case| along_axes(case, cases)).collect();
    if keys(cases).is_empty() {
        let own = |style| Look { style, key: None };
        return (0..cases.len()).map(own).collect();
    }
    let place = |values: &mut Vec<String>, value: &str| {
        values.iter().position(|known| known == value).unwrap_or_else(|| {
            values.push(value.to_owned());
            values.len() - 1
        })
    };
    let [mut colors, mut dashes] = [Vec::new(), Vec::new()];
    let look = |labels: &Vec<String>| {
        let (first, others) = labels.split_first()?;
        let others = others.join(", ");
        let color = place(&mut colors, first) % palette::LINES.len();
        let dash = place(&mut dashes, &others) % palette::DASHES.len();
        Some(Look {
            style: palette::style(color, dash),
            key: Some(Key {
                color: first.clone(),
                dash: (!others.is_empty()).then_some(others),
            }),
        })
    };
    labels.iter().map(look).map(Option::unwrap_or_default).collect()
}

/// What each line of the sweep has set in a case, in words, and the case that it started from where there are several.
fn along_axes(case: &Analysed, cases: &[Analysed]) -> Vec<String> {
    let swept = &case.result.swept;
    let axes = swept.iter().map(|swept| swept.axis).max().map_or(0, |last| last + 1);
    let of_axis = |axis| {
        swept
            .iter()
            .filter(move |swept| swept.axis == axis)
            .map(|swept| words(swept, keys(cases)))
    };
    let mut labels: Vec<String> = (0..axes)
        .map(|axis| of_axis(axis).collect::<Vec<_>>().join(", "))
        .collect();
    if cases.iter().any(|other| other.result.origin != case.result.origin) {
        labels.push(case.result.origin.clone());
    }
    labels
}

/// The cases along the first swept key that is a number: a series for each choice of all else, its cases by rising value.
pub fn series<'a>(cases: &'a [Analysed<'a>]) -> Option<(&'a Swept, Vec<Series<'a>>)> {
    let index = keys(cases).iter().position(|key| key.number().is_some())?;
    let key = &keys(cases)[index];
    let mut found: Vec<Series> = Vec::new();
    for case in cases {
        let Some(x) = case.result.swept.get(index).and_then(Swept::number) else {
            continue;
        };
        let mut others = along_axes(case, cases);
        others.remove(key.axis);
        let name = others.join(", ");
        match found.iter_mut().find(|series| series.name == name) {
            Some(series) => series.cases.push((x, case)),
            None => found.push(Series {
                name,
                cases: vec![(x, case)],
            }),
        }
    }
    for series in &mut found {
        series.cases.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let several = found.iter().any(|series| series.cases.len() > 1);
    several.then_some((key, found))
}

/// Cases that differ in the first swept number alone.
pub struct Series<'a> {
    /// What they have in common; empty where there is one series.
    pub name: String,
    /// The swept number, and the case that has it.
    pub cases: Vec<(f64, &'a Analysed<'a>)>,
}
