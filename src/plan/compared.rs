//! The tables of a report that values from elsewhere can be set beside.

/// A table that can be compared, and its columns.
pub struct Compared {
    pub table: &'static str,
    /// Column that tells what a row is of.
    pub row: &'static str,
    /// Columns that tell the rows of one case apart, and all the words that they may hold.
    pub keys: &'static [(&'static str, &'static [&'static str])],
    pub values: &'static [&'static str],
}

impl Compared {
    /// What a file may have of it, in words.
    pub fn columns(&self) -> String {
        let keys: String = self.keys.iter().map(|key| format!("`{}`, ", key.0)).collect();
        match self.values {
            [value] => format!("{keys}`{value}` of `{}`", self.table),
            _ => format!("{keys}columns of `{}`", self.table),
        }
    }
}

pub const COMPARED: [Compared; 6] = [
    Compared {
        table: "summary",
        row: CASE,
        keys: &[],
        values: &[
            "nodes",
            "elements",
            "represented_atoms",
            "steps",
            "time_step_ps",
            "wall_s",
            "atom_steps_per_s",
            "energy_error_relative",
            "closest_approach_spacings",
            "cutoff_release_ev",
            "initiation_strain",
            "initiation_time_ps",
            "k_ic_near_tip_mpa_sqrt_m",
            "k_ic_j_integral_mpa_sqrt_m",
            "k_griffith_mpa_sqrt_m",
            "peak_speed_over_c_r",
            "first_branch_time_ps",
            "first_branch_strain",
            "first_bond_strain",
            "first_bond_time_ps",
            "speed_share",
            "joins",
            "leaves_plane_time_ps",
            "leaves_plane_strain",
            "parted_elsewhere_strain",
            // Of solids.
            "core_s",
            "modulus_gpa",
            "peak_stress_gpa",
            "peak_time_ps",
            "peak_strain",
            "first_break_time_ps",
            "first_break_strain",
            "broken_bonds",
            "period_ps",
            // Of slabs under a pulse.
            "wave_speed_m_per_s",
        ],
    },
    Compared {
        table: "wave_arrival",
        row: CASE,
        keys: &[
            ("wave", &["longitudinal", "transverse", "rayleigh"]),
            ("path", &["left face", "right face", "top and bottom faces"]),
        ],
        values: &["reference_ps"],
    },
    Compared {
        table: "k_ic",
        row: CASE,
        keys: &[],
        values: &["k_ic_reference_mpa_sqrt_m"],
    },
    Compared {
        table: "first_branch",
        row: CASE,
        keys: &[],
        values: &["reference_from_ps", "reference_to_ps"],
    },
    Compared {
        table: "speed_against_error",
        row: CASE,
        keys: &[],
        values: &["core_seconds_per_ps", "peak_memory_mib"],
    },
    Compared {
        table: SCALING,
        row: RANKS,
        keys: &[],
        values: &[
            "elements",
            "steps",
            "inp_s",
            "getm_s",
            "elist_s",
            "exc_s_per_step",
            "solv_s_per_step",
            "out_s",
        ],
    },
];

/// The table of what ranks gain.
pub const SCALING: &str = "scaling";

/// The column that names cases.
pub const CASE: &str = "case";
/// The column of numbers of ranks.
pub const RANKS: &str = "ranks";
