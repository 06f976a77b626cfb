//! A slab: material, specimen, crack, loading and gauges together.

mod loading;
mod pulse;

use super::{Check, Table, tables};
use crate::study::{
    case::{Body, Run, Slab},
    file::CaseFile,
    finding::Place,
};

impl Check<'_> {
    /// The slab, its run, and the tables that its report shows.
    pub fn slab(&self, case: &CaseFile, place: Place) -> (Option<Body>, Option<Run>, Vec<Table>) {
        self.refuse_what_a_slab_has_not(case);
        let mut tables = tables(&case.observe);
        let (material, spacing) = self.sheet(&case.material, place);
        let element = case.resolution.right();
        let element = element.and_then(|values| values.element.right().copied());
        let specimen = self.specimen(&case.specimen, place, spacing, element);
        let resolution = self.resolution(&case.resolution, place, &specimen);
        let crack = self.crack(&case.crack, &specimen);
        let loading = self.loading(&case.loading, place, &specimen);
        let (run, stops) = self.run(&case.run, place);
        let refines = resolution
            .as_ref()
            .is_some_and(|resolution| resolution.refine.is_some());
        let run = match refines {
            true => run.and_then(|run| self.run_of_refined(run, &case.run)),
            false => run,
        };
        if let (Some(stops), Some(crack)) = (stops, &crack) {
            self.stops(stops, crack.as_ref(), &specimen);
        }
        if matches!(crack, Some(None)) {
            self.observes_no_crack(&case.observe);
            tables.retain(|table| !matches!(table, Table::Crack | Table::WaveArrival));
        }
        if pulse::is_pulse(case) {
            self.refuse_what_a_pulse_has_not(case);
            tables = vec![Table::AverageStress];
        }
        let gauges = self.slab_gauges(case, &specimen);
        let slab = || {
            Some(Slab {
                material: material?,
                specimen: specimen.specimen?,
                resolution: resolution?,
                crack: crack?.map(|(crack, _)| crack),
                loading: loading?,
                gauges: gauges?,
            })
        };
        (slab().map(Body::Slab), run, tables)
    }
}
