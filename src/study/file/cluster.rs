use super::super::{quantity::Duration, reader::Given};
use schemars::JsonSchema;
use serde::Deserialize;

/// What each job of a cluster gets; no part of what is computed. `cluster.yaml` in one's own configuration may say the
/// same for all studies; what a study says stands over it.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "Cluster")]
pub struct ClusterFile {
    /// Partition to wait in; the cluster's own choice where left out.
    pub partition: Given<String>,
    /// Account that pays.
    pub account: Given<String>,
    /// Longest time of one job, at least 1 min. A case that needs longer writes a checkpoint before it ends and queues
    /// again.
    pub time: Given<Duration>,
    /// Nodes that the ranks of a case are spread over; 1 where left out.
    #[schemars(range(min = 1))]
    pub nodes: Given<u32>,
    /// MPI ranks of a case that does not say so itself; 1 where left out.
    #[schemars(range(min = 1))]
    pub ranks: Given<u32>,
    /// Threads of each rank of a case that does not say so itself; 1 where left out.
    #[schemars(range(min = 1))]
    pub threads: Given<u32>,
    /// Environment modules to load on the node.
    pub modules: Given<Vec<Given<String>>>,
    /// Lines of shell that run on the node before the case.
    pub preamble: Given<String>,
    /// Further options of `sbatch`, such as `--mem=8G`.
    pub options: Given<Vec<Given<String>>>,
}
