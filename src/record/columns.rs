//! Series of any columns in HDF5: one dataset a column, in the units that its attribute `units` names, as in every series.

use hdf5::Group;
use hdf5::types::VarLenUnicode;

use super::arrays::{Packing, get, get_column, get_scalar, new_group, put, put_scalar};
use super::rows::{Described, Rows};
use crate::analysis::columns::{Column, Columns, SolidSetting};

/// Attribute of the group of the columns: their names in order, with blanks between them.
const NAMES: &str = "columns";

impl Rows for Columns {
    fn put(&self, parent: &Group) -> hdf5::Result<()> {
        let group = new_group(parent, "probes")?;
        let names: Vec<&str> = self.columns.iter().map(|column| column.name.as_str()).collect();
        let names: VarLenUnicode = names.join(" ").parse().map_err(|_| "a name contains a zero byte")?;
        group.new_attr::<VarLenUnicode>().create(NAMES)?.write_scalar(&names)?;
        let shape = [self.steps.len()];
        put(&group, "step", "1", &shape, &self.steps, Packing::Deflated)?;
        for Column { name, unit, numbers } in &self.columns {
            put(&group, name, unit, &shape, numbers, Packing::Deflated)?;
        }
        Ok(())
    }

    fn get(parent: &Group) -> hdf5::Result<Self> {
        let group = parent.group("probes")?;
        let steps: Vec<u64> = get(&group, "step")?;
        let names: VarLenUnicode = group.attr(NAMES)?.read_scalar()?;
        let column = |name: &str| -> hdf5::Result<Column> {
            let unit: VarLenUnicode = group.dataset(name)?.attr("units")?.read_scalar()?;
            Ok(Column {
                name: name.to_owned(),
                unit: unit.to_string(),
                numbers: get_column(&group, name, steps.len())?,
            })
        };
        let columns = names.split_whitespace().map(column).collect::<hdf5::Result<_>>()?;
        Ok(Self { steps, columns })
    }

    fn steps(&self) -> Vec<u64> {
        self.steps.clone()
    }

    fn append(&mut self, part: Self) -> Result<(), String> {
        self.append(part)
    }

    fn truncate(&mut self, rows: usize, _first: u64) {
        self.truncate(rows);
    }
}

impl Described for SolidSetting {
    type Rows = Columns;

    fn put(&self, parent: &Group) -> hdf5::Result<()> {
        // Taken apart by name, so that a new member cannot be forgotten here.
        let Self {
            spacing,
            volume,
            length,
            along,
            strain_rate,
            nodes,
            elements,
            represented_atoms,
        } = self;
        let group = new_group(parent, "setting")?;
        for (name, unit, number) in [
            ("spacing", "nm", spacing),
            ("volume", "nm^3", volume),
            ("length", "nm", length),
            ("strain_rate", "1/ps", strain_rate),
        ] {
            put_scalar(&group, name, unit, *number)?;
        }
        put(&group, "along", "1", &[3], along, Packing::Plain)?;
        for (name, count) in [
            ("nodes", nodes),
            ("elements", elements),
            ("represented_atoms", represented_atoms),
        ] {
            put_scalar(&group, name, "1", *count)?;
        }
        Ok(())
    }

    fn get(parent: &Group) -> hdf5::Result<Self> {
        let group = &parent.group("setting")?;
        let along: Vec<f64> = get_column(group, "along", 3)?;
        Ok(Self {
            spacing: get_scalar(group, "spacing")?,
            volume: get_scalar(group, "volume")?,
            length: get_scalar(group, "length")?,
            along: [along[0], along[1], along[2]],
            strain_rate: get_scalar(group, "strain_rate")?,
            nodes: get_scalar(group, "nodes")?,
            elements: get_scalar(group, "elements")?,
            represented_atoms: get_scalar(group, "represented_atoms")?,
        })
    }
}
