//! Level of the pressure: fixed by a surface, otherwise a mean of zero.

/// Reference that fixes the level of the pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Gauge {
    /// A surface.
    #[default]
    Surface,
    /// No pressure is fixed.
    Free,
}

impl Gauge {
    /// Subtracts the mean from a field where nothing fixes the level.
    pub(crate) fn take_mean_out(self, field: &mut [f64]) {
        if self == Self::Free {
            let mean = field.iter().sum::<f64>() / field.len() as f64;
            field.iter_mut().for_each(|value| *value -= mean);
        }
    }

    /// The operator among fields of mean zero where nothing fixes the level: symmetric, as it is.
    pub(crate) fn apply(
        self,
        p: &[f64],
        product: &mut [f64],
        deviation: &mut Vec<f64>,
        operator: impl FnOnce(&[f64], &mut [f64]),
    ) {
        match self {
            Self::Surface => operator(p, product),
            Self::Free => {
                deviation.clear();
                deviation.extend_from_slice(p);
                self.take_mean_out(deviation);
                operator(deviation, product);
                self.take_mean_out(product);
            }
        }
    }
}
