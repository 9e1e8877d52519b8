//! Do matrices, blocks, vectors and masks keep the equations that define them?
#![allow(clippy::unwrap_used)]

use eigenring::analysis::{Analysis, Analyzer};
use eigenring::numbers::RootsOfUnity;
use eigenring::refine::is_dual;
use eigenring::scheme::{Scheme, catalogue};
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

fn schemes() -> Vec<Scheme> {
    catalogue::SCHEMES.iter().map(|listed| catalogue::open(listed.id).unwrap().unwrap()).collect()
}

/// Calls `test` with the analysis of every scheme of the catalogue at n = 3..12.
fn everywhere(test: impl Fn(&str, &Analyzer, &Analysis)) {
    for scheme in schemes() {
        let analyzer = Analyzer::new(&scheme).unwrap();
        for n in 3..=12 {
            test(&format!("{} at n = {n}", scheme.id), &analyzer, &analyzer.at(n).unwrap());
        }
    }
}

/// A fixed sequence of numbers in (-1, 1) without a pattern.
fn noise(count: usize) -> DVector<f64> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    DVector::from_fn(count, |_, _| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

/// A mask as a row vector over all points.
fn row_vector(analysis: &Analysis, mask: &eigenring::analysis::masks::Mask) -> DVector<f64> {
    let mut row = DVector::zeros(analysis.local.size());
    for (label, weight) in mask.weights(&analysis.local) {
        let orbit = analysis.local.orbits.iter().position(|orbit| *orbit == label.orbit());
        row[analysis.local.column(orbit, label.sector)] = weight;
    }
    row
}

#[test]
fn rows_of_the_local_matrix_sum_to_1() {
    everywhere(|at, _, analysis| {
        for row in 0..analysis.local.size() {
            let sum: f64 = analysis.local.row(row).iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{at}, row {row}: {sum}");
        }
    });
}

#[test]
fn the_matrix_commutes_with_rotation_and_reflection() {
    everywhere(|at, _, analysis| {
        let (s, local) = (analysis.local.dense().unwrap(), &analysis.local);
        let index = |label: eigenring::mesh::Label| {
            local.column(local.orbits.iter().position(|orbit| *orbit == label.orbit()), label.sector)
        };
        for row in 0..local.size() {
            for column in 0..local.size() {
                let (p, q) = (local.label(row), local.label(column));
                let rotated = s[(index(local.patch.rotated(p, 1)), index(local.patch.rotated(q, 1)))];
                let mirrored = s[(index(local.patch.mirrored(p)), index(local.patch.mirrored(q)))];
                assert!((s[(row, column)] - rotated).abs() < 1e-15, "{at}");
                assert!((s[(row, column)] - mirrored).abs() < 1e-15, "{at}");
            }
        }
    });
}

#[test]
fn the_blocks_rebuild_the_matrix() {
    everywhere(|at, _, analysis| {
        let (rebuilt, local) = (analysis.blocks.rebuilt_rows(), &analysis.local);
        let s = local.dense().unwrap();
        for (t, sectors) in rebuilt.iter().enumerate() {
            for (d, weights) in sectors.iter().enumerate() {
                for (u, weight) in weights.iter().enumerate() {
                    let true_weight = s[(local.column(Some(t), 0), local.column(Some(u), d as u32))];
                    assert!((weight - true_weight).abs() < 1e-15, "{at}: orbit {t} from orbit {u} of sector {d}");
                }
            }
        }
    });
}

/// S (x of frequency k) = (B_k y) of frequency k, for every k, by the dense matrix.
#[test]
fn a_block_does_to_a_wave_what_the_matrix_does() {
    everywhere(|at, _, analysis| {
        let (local, n) = (&analysis.local, analysis.valence);
        let (s, roots) = (local.dense().unwrap().map(|w| Complex64::new(w, 0.0)), RootsOfUnity::new(n));
        for k in 0..n {
            let block = analysis.blocks.block(k);
            let seed = noise(2 * block.nrows());
            let y = DVector::from_fn(block.nrows(), |t, _| Complex64::new(seed[2 * t], seed[2 * t + 1]));
            let offset = block.nrows() - local.orbits.len();
            let spread = |y: &DVector<Complex64>| {
                let mut x = DVector::from_element(local.size(), Complex64::ZERO);
                if offset == 1 {
                    x[0] = y[0];
                }
                for sector in 0..n {
                    for t in 0..local.orbits.len() {
                        x[local.column(Some(t), sector as u32)] = y[t + offset] * roots.get((k * sector) as i64);
                    }
                }
                x
            };
            let difference = (&s * spread(&y) - spread(&(&block * &y))).camax();
            assert!(difference < 1e-14, "{at}, k = {k}: {difference}");
        }
    });
}

/// The sum of the p-th powers of the eigenvalues is the trace of S^p: true for Jordan blocks too, where eigenvalues of
/// the dense matrix are worth little.
#[test]
fn powers_of_the_dense_matrix_have_the_traces_that_the_blocks_say() {
    everywhere(|at, _, analysis| {
        let s = analysis.local.dense().unwrap();
        let mut power = DMatrix::identity(s.nrows(), s.nrows());
        for p in 1..=12 {
            power = &power * &s;
            let eigenvalues = analysis.spectrum.eigenvalues.iter();
            let weight = |k: usize| if k == 0 || 2 * k == analysis.valence { 1.0 } else { 2.0 };
            let sum: f64 = eigenvalues.map(|e| e.value.powi(p).re * weight(e.frequency)).sum();
            assert!((power.trace() - sum).abs() < 1e-12, "{at}, p = {p}: {} and {sum}", power.trace());
        }
    });
}

/// Pair by pair the dense eigenvalues are those of the blocks, as near as defective matrices allow (Doo-Sabin at n >= 5 has
/// Jordan blocks of size 2, butterfly's regular point of size 3).
#[test]
fn the_dense_spectrum_is_that_of_the_blocks() {
    everywhere(|at, _, analysis| {
        let dense = analysis.local.dense().unwrap();
        // off-diagonal entries below 1e-12 count as zero: with nothing allowed the iteration can go on for ever
        let schur = dense.try_schur(1e-12, 100_000).expect("the dense iteration converges");
        let mut left: Vec<Complex64> = schur.complex_eigenvalues().iter().copied().collect();
        assert_eq!(left.len(), analysis.local.size());
        let mut count = 0;
        for e in &analysis.spectrum.eigenvalues {
            for _ in 0..e.multiplicity(analysis.valence) / e.cluster {
                let distance = |z: &Complex64| (z - e.value).norm();
                let nearest =
                    (0..left.len()).min_by(|a, b| distance(&left[*a]).total_cmp(&distance(&left[*b]))).unwrap();
                assert!(distance(&left[nearest]) < 5e-4, "{at}: {e:?} and {}", left[nearest]);
                left.swap_remove(nearest);
                count += 1;
            }
        }
        assert_eq!((count, left.len()), (analysis.local.size(), 0), "{at}");
    });
}

#[test]
fn vectors_keep_their_equations() {
    everywhere(|at, _, analysis| {
        let (spectrum, blocks, cores) = (&analysis.spectrum, &analysis.blocks, &analysis.cores);
        let mut seen = 0;
        for e in spectrum.eigenvalues.iter().filter(|e| e.is_isolated() && e.real().is_some()) {
            let block = blocks.block(e.frequency);
            let vector = |mode: &eigenring::analysis::blocks::ModeVector| {
                let centre = (block.nrows() > mode.orbits.len()).then(|| Complex64::new(mode.centre, 0.0));
                let entries: Vec<Complex64> = centre.into_iter().chain(mode.orbits.iter().copied()).collect();
                DVector::from_vec(entries)
            };
            let right = vector(&spectrum.right_vector(blocks, cores, e).unwrap().0);
            let left = vector(&spectrum.left_vector(blocks, cores, e).unwrap().0);
            assert!((&block * &right - &right * e.value).camax() < 1e-14 * right.camax(), "{at}: right of {e:?}");
            assert!(
                (block.transpose() * &left - &left * e.value).camax() < 1e-14 * left.camax(),
                "{at}: left of {e:?}"
            );
            assert!(
                left.dot(&right).norm() > 1e-6 || e.approx_error > 1e-10,
                "{at}: the vectors of a simple eigenvalue are not orthogonal, {e:?}"
            );
            seen += 1;
        }
        assert!(seen >= 2, "{at}");
    });
}

/// The subdominant eigenvalue; that of two schemes is not of frequency 1, or has a Jordan block, at some valences.
fn lambda_at(at: &str, analysis: &Analysis) -> Option<f64> {
    let lambda = analysis.lambda.map(|lambda| lambda.value.re);
    let none = at.starts_with("butterfly") && (analysis.valence == 3 || analysis.valence >= 8);
    let degenerate = at.starts_with("mid-edge") && analysis.valence == 3;
    assert_eq!(lambda.is_none(), none || degenerate, "{at}");
    lambda
}

/// u S = lambda u over the whole matrix, and so a mask survives a refinement step.
#[test]
fn masks_survive_a_refinement_step() {
    everywhere(|at, _, analysis| {
        let s = analysis.local.dense().unwrap();
        let points = noise(analysis.local.size());
        let refined = &s * &points;
        let limit = row_vector(analysis, analysis.limit_mask.as_ref().unwrap());
        assert!((limit.sum() - 1.0).abs() < 1e-14, "{at}");
        assert!((s.transpose() * &limit - &limit).amax() < 1e-14, "{at}");
        assert!((limit.dot(&points) - limit.dot(&refined)).abs() < 1e-13, "{at}");
        let Some(lambda) = lambda_at(at, analysis) else { return };
        for mask in analysis.tangent_masks.as_ref().unwrap() {
            let tangent = row_vector(analysis, mask);
            assert!(tangent.sum().abs() < 1e-13, "{at}: a tangent mask of constants is zero");
            assert!((s.transpose() * &tangent - &tangent * lambda).amax() < 1e-13, "{at}");
            assert!((tangent.dot(&points) * lambda - tangent.dot(&refined)).abs() < 1e-12, "{at}");
        }
    });
}

/// Deep refinement of the neighbourhood, by the matrix alone: points go to the mask's limit, at the rate lambda.
#[test]
fn refined_points_converge_to_the_limit_that_the_mask_says() {
    everywhere(|at, _, analysis| {
        let s = analysis.local.dense().unwrap();
        let mut points = noise(analysis.local.size());
        let limit = row_vector(analysis, analysis.limit_mask.as_ref().unwrap()).dot(&points);
        for _ in 0..70 {
            points = &s * points;
        }
        let error = points.iter().map(|x| (x - limit).abs()).fold(0.0, f64::max);
        let lambda = analysis.spectrum.subdominant().unwrap().modulus();
        assert!(error < 100.0 * lambda.powi(70) + 1e-13, "{at}: {error}");
    });
}

#[test]
fn tangent_masks_have_their_normal_form() {
    everywhere(|at, _, analysis| {
        let n = analysis.valence;
        if lambda_at(at, analysis).is_none() {
            return;
        }
        let [cosine, sine] = analysis.tangent_masks.as_ref().unwrap();
        let roots = RootsOfUnity::new(n);
        for sector in 0..n as u32 {
            let angle = roots.get(i64::from(sector));
            assert!((cosine.weight(sector, 0, &roots) - angle.re).abs() < 1e-14, "{at}");
            assert!((sine.weight(sector, 0, &roots) - angle.im).abs() < 1e-14, "{at}");
        }
        let label = |(label, weight): (eigenring::mesh::Label, f64)| (analysis.local.patch.mirrored(label), weight);
        let weights = |mask: &eigenring::analysis::masks::Mask| mask.weights(&analysis.local);
        for (mask, sign) in [(cosine, 1.0), (sine, -1.0)] {
            for (mirrored, weight) in weights(mask).into_iter().map(label) {
                let own = weights(mask).into_iter().find(|(at, _)| *at == mirrored).unwrap().1;
                assert!((own - sign * weight).abs() < 1e-13, "{at}");
            }
        }
    });
}

/// At the regular valence the characteristic map is linear: its net is the lattice and its Jacobian constant.
#[test]
fn at_the_regular_valence_the_characteristic_map_is_the_lattice() {
    for scheme in schemes() {
        let analyzer = Analyzer::new(&scheme).unwrap();
        let analysis = analyzer.at(scheme.regular_valence()).unwrap();
        let roots = RootsOfUnity::new(scheme.regular_valence());
        let (along, over) = (roots.get(0), roots.get(1));
        for (orbit, point) in analysis.local.orbits.iter().zip(&analysis.map.as_ref().unwrap().net) {
            let (i, j) = (f64::from(orbit.0), f64::from(orbit.1));
            let lattice = if is_dual(&scheme) {
                // corner 0 lies at 1, half-way between the axes of the lattice
                Complex64::new(1.0 + i + j, -i + j)
            } else {
                along * i + over * j
            };
            assert!((point - lattice).norm() < 1e-13, "{} {orbit:?}: {point} and {lattice}", scheme.id);
        }
        let shape = analysis.map.unwrap().shape.unwrap();
        assert!((shape.approx_least_jacobian - 1.0).abs() < 1e-12, "{}", scheme.id);
    }
}

/// The Jacobian by tangent masks has the sign and the size of finite differences of limit points on a finer ring.
#[test]
fn jacobians_agree_with_finite_differences() {
    for scheme in schemes() {
        let analyzer = Analyzer::new(&scheme).unwrap();
        for n in [3, 5, 8] {
            let analysis = analyzer.at(n).unwrap();
            if lambda_at(&format!("{} at n = {n}", scheme.id), &analysis).is_none() {
                continue;
            }
            let (_, samples) = analyzer.picture_of_map(&analysis, 2).unwrap().unwrap().samples.unwrap();
            let at = |i: i32, j: i32| samples.iter().find(|sample| sample.at == (i, j));
            let mut ratios = Vec::new();
            for sample in &samples {
                let (i, j) = sample.at;
                let around = (at(i + 1, j), at(i - 1, j), at(i, j + 1), at(i, j - 1));
                if let (Some(east), Some(west), Some(north), Some(south)) = around {
                    let cross = ((east.point - west.point).conj() * (north.point - south.point)).im;
                    ratios.push(cross / sample.jacobian);
                }
            }
            let (least, most) = ratios.iter().fold((f64::INFINITY, 0.0), |(a, b), r| (r.min(a), r.max(b)));
            assert!(ratios.len() > 20 && least > 0.0 && most / least < 1.2, "{} n = {n}: {least} to {most}", scheme.id);
        }
    }
}
