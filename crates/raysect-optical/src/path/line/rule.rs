/// Nodes of a cell.
pub(super) const NODES: usize = 5;
/// Weights of the Gauss-Lobatto rule on (0, 1), whose nodes are the ends, the middle and (1 ± √(3/7)) / 2
/// (M. Abramowitz and I. Stegun, *Handbook of Mathematical Functions*, 25.4.32). With nodes at the ends no jump can hide
/// between the last node of a cell and the first of the next.
const WEIGHTS: [f64; NODES] = [1.0 / 20.0, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 1.0 / 20.0];
/// So far inside a cell, in units of its width, lie the nodes at its ends: on the near side of a break.
const INSIDE: f64 = 1e-9;

/// A rule for cells: where to ask, and how to integrate up to there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rule {
    pub(super) nodes: [f64; NODES],
    pub(super) weights: [f64; NODES],
    /// Integral from 0 to a node of the polynomial through all of them: `[node][value]`.
    pub(super) partial: [[f64; NODES]; NODES],
}

impl Rule {
    pub(super) fn new() -> Self {
        let inner = 0.5 * (3.0f64 / 7.0).sqrt();
        let lobatto = [0.0, 0.5 - inner, 0.5, 0.5 + inner, 1.0];
        let nodes = lobatto.map(|x: f64| x.clamp(INSIDE, 1.0 - INSIDE));
        let lagrange = |r: usize, x: f64| {
            let others = (0..NODES).filter(|&k| k != r);
            others.map(|k| (x - nodes[k]) / (nodes[r] - nodes[k])).product::<f64>()
        };
        let to = |x: f64, r: usize| -> f64 {
            (0..NODES).map(|k| WEIGHTS[k] * lagrange(r, x * lobatto[k])).sum::<f64>() * x
        };
        let partial = std::array::from_fn(|q| std::array::from_fn(|r| to(nodes[q], r)));
        Self { nodes, weights: std::array::from_fn(|r| to(1.0, r)), partial }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_integrates_polynomials_exactly() {
        let rule = Rule::new();
        for power in 0..8 {
            let whole: f64 = (0..NODES).map(|q| rule.weights[q] * rule.nodes[q].powi(power)).sum();
            assert!((whole - 1.0 / f64::from(power + 1)).abs() < 1e-8, "{power}: {whole}");
        }
        for power in 0..NODES as i32 {
            for q in 0..NODES {
                let part: f64 = (0..NODES).map(|r| rule.partial[q][r] * rule.nodes[r].powi(power)).sum();
                let exact = rule.nodes[q].powi(power + 1) / f64::from(power + 1);
                assert!((part - exact).abs() < 1e-14, "{power} {q}");
            }
        }
    }
}
