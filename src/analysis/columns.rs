//! Time series of any columns, and what must be known of the solid that they tell of.

/// What a solid was, as far as its series must be understood. Internal units (nm, ps, eV).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolidSetting {
    /// Distance of nearest neighbours, nm.
    pub spacing: f64,
    /// Reference volume of all sites, nm^3: what stresses and energies are over.
    pub volume: f64,
    /// What the nominal strain is over, nm, and the direction in which it is measured.
    pub length: f64,
    pub along: [f64; 3],
    /// Nominal, 1/ps; not a number where the loading does not prescribe it.
    pub strain_rate: f64,
    pub nodes: u64,
    pub elements: u64,
    pub represented_atoms: u64,
}

/// A column of a series: a number a probe.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: String,
    /// Of the numbers, as in `eV/nm^3`.
    pub unit: String,
    pub numbers: Vec<f64>,
}

/// Columns of equal length, and the step of each of their rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    pub steps: Vec<u64>,
    pub columns: Vec<Column>,
}

impl Columns {
    /// No rows yet, under names and units.
    pub fn named(names: impl IntoIterator<Item = (String, &'static str)>) -> Self {
        let column = |(name, unit): (String, &str)| Column {
            name,
            unit: unit.to_owned(),
            numbers: Vec::new(),
        };
        Self {
            steps: Vec::new(),
            columns: names.into_iter().map(column).collect(),
        }
    }

    /// The numbers under a name.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        let column = self.columns.iter().find(|column| column.name == name)?;
        Some(&column.numbers)
    }

    /// Takes one more row, a number a column.
    pub fn push(&mut self, step: u64, row: &[f64]) {
        assert_eq!(row.len(), self.columns.len(), "a row has a number for every column");
        self.steps.push(step);
        let columns = self.columns.iter_mut().zip(row);
        columns.for_each(|(column, &number)| column.numbers.push(number));
    }

    /// The same columns without rows.
    pub fn emptied(&self) -> Self {
        let mut emptied = self.clone();
        emptied.truncate(0);
        emptied
    }

    /// Keeps so many rows.
    pub fn truncate(&mut self, rows: usize) {
        self.steps.truncate(rows);
        self.columns.iter_mut().for_each(|column| column.numbers.truncate(rows));
    }

    /// Takes the rows of a later part; refuses one with other columns.
    pub fn append(&mut self, part: Self) -> Result<(), String> {
        if self.columns.is_empty() {
            *self = part;
            return Ok(());
        }
        let names = |columns: &Self| -> Vec<(String, String)> {
            let columns = columns.columns.iter();
            columns
                .map(|column| (column.name.clone(), column.unit.clone()))
                .collect()
        };
        if names(self) != names(&part) {
            return Err("its columns are not those of the segments before it".to_owned());
        }
        self.steps.extend(part.steps);
        let columns = self.columns.iter_mut().zip(part.columns);
        columns.for_each(|(column, more)| column.numbers.extend(more.numbers));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(rows: std::ops::Range<u32>) -> Columns {
        let mut columns = Columns::named([("time".to_owned(), "ps"), ("work".to_owned(), "eV")]);
        for row in rows {
            columns.push(u64::from(10 * row), &[f64::from(row), f64::from(row * row)]);
        }
        columns
    }

    #[test]
    fn parts_come_together_again_and_foreign_ones_are_refused() {
        let mut whole = columns(0..3);
        whole.append(columns(3..7)).unwrap();
        assert_eq!(whole, columns(0..7));
        assert_eq!(whole.get("work"), Some(&[0.0, 1.0, 4.0, 9.0, 16.0, 25.0, 36.0][..]));
        whole.truncate(4);
        assert_eq!(whole, columns(0..4));
        let mut foreign = columns(4..5);
        foreign.columns[1].unit = "J".to_owned();
        assert!(whole.append(foreign).is_err());
        let mut first = Columns::default();
        first.append(columns(0..2)).unwrap();
        assert_eq!((first, columns(0..2).emptied()), (columns(0..2), columns(0..0)));
    }
}
