//! A crack that joins one that has opened ahead of it.

use super::plaquette::Bond;
use super::{BONDS_A_SPACING, Tip, Tracker};

/// What a crack has joined, in units of lengths, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joined {
    /// Length of the bonds that parted the two, along the path.
    pub gap: f64,
    /// Length of what was open beyond them.
    pub length: f64,
}

impl Tracker {
    /// Whether the foremost tip has gone ahead of an earlier one, on a way that leads beyond it through bonds that had broken
    /// before this probe: they hung together with the notch then as little as what is shorter than a spur, which is not told.
    pub fn joined(&self, earlier: Tip, probe: u32, spur: usize) -> Option<Joined> {
        let length = |bonds: usize| bonds as f64 * self.notch.spacing / BONDS_A_SPACING as f64;
        let path = self.main_path();
        path.last().filter(|&&last| self.notch.place(last)[0] > earlier.x)?;
        let was_open = |bond: &Bond| self.opened(*bond) < probe;
        let ahead = |bond: &&Bond| self.notch.place(**bond)[0] > earlier.x && was_open(bond);
        let open = path.iter().filter(ahead).count();
        let first = path.iter().position(|bond| ahead(&bond))?;
        let gap = path[..first].iter().filter(|bond| !was_open(bond)).count();
        (open >= spur * BONDS_A_SPACING).then(|| Joined {
            gap: length(gap),
            length: length(open),
        })
    }
}
