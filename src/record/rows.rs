//! What a run writes a row of at every probe.

use hdf5::Group;

/// The rows of a time series: written stretch by stretch, put together again, and cut back.
pub trait Rows: Default {
    fn put(&self, group: &Group) -> hdf5::Result<()>;

    /// Reads what [`Self::put`] wrote.
    fn get(group: &Group) -> hdf5::Result<Self>;

    /// The step of every row.
    fn steps(&self) -> Vec<u64>;

    /// Takes the rows of a later part; refuses one that does not fit.
    fn append(&mut self, part: Self) -> Result<(), String>;

    /// Keeps so many rows of a part whose first row is the run's row `first`.
    fn truncate(&mut self, rows: usize, first: u64);
}

/// What must be known of a specimen to understand its series.
pub trait Described {
    type Rows: Rows;

    fn put(&self, group: &Group) -> hdf5::Result<()>;

    /// Reads what [`Self::put`] wrote.
    fn get(group: &Group) -> hdf5::Result<Self>
    where
        Self: Sized;
}
