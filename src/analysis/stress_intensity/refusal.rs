//! Why a definition of the stress intensity gives no number.

/// What does not hold. Its sentence stands in tables and in the report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    OffPlane,
    FewBins,
    NotPositive,
    LargeError,
    SmallRange,
    NoRings,
    Outflow,
    UnlikeRings,
    BelowGriffith,
    NotFromAnEdge,
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(match self {
            Self::OffPlane => "the tip has left the plane along which the stress is recorded",
            Self::FewBins => "there is no room for the fit between the elements at the tip and the edges of the specimen",
            Self::NotPositive => "the stress does not rise towards the tip",
            Self::LargeError => "the stress ahead of the tip scatters too much about the fit",
            Self::SmallRange => "the singular field is not the larger part of the stress that is fitted",
            Self::NoRings => "there is no room for rings around the tip, or none are read",
            Self::Outflow => "waves take more energy out of a ring than flows in",
            Self::UnlikeRings => "the rings do not agree: the field around the tip is not that of a crack",
            Self::NotFromAnEdge => "its factor is that of a crack from an edge, and this one reaches none",
            Self::BelowGriffith => {
                "less energy would flow to the tip than its surfaces cost: the field around it is not that of a crack that \
                 is about to run, because waves of the loading pass it or bonds have parted within the rings"
            }
        })
    }
}
