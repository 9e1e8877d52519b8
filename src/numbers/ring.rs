//! What is the sum of a ring's weights at each frequency?
//!
//! A ring has n points whatever the patch at hand, and a weight on it is a trigonometric sum in the index j:
//!
//! > g(j) = sum_p A_p cos(2 pi p j/n) + B_p sin(2 pi p j/n).
//!
//! With w = exp(2 pi i/n) its sum at frequency k, sum_j g(j) w^(k j), is read off: n A_0 at k = 0, n A_p/2 at k = +-p (n A_p where
//! these are one), nothing elsewhere. So a whole ring acts at each frequency like one point, whose weight is a
//! [`PerFrequency`]; a local weight is one that is the same at all of them.

use super::world::{Angle, World};
use super::{Field, Trouble};
use dashu_ratio::RBig;
use std::collections::{BTreeMap, BTreeSet};

const NO_WAVE: Trouble = Trouble::BeyondThisWorld("the weights of this ring are not a sum of cosines of 2*pi*p*j/n");

/// A trigonometric sum in the index of a ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Series<F> {
    /// A_p by p >= 0.
    cos: BTreeMap<i64, F>,
    /// B_p by p >= 1.
    sin: BTreeMap<i64, F>,
}

impl<F: Field> Series<F> {
    fn constant(value: F) -> Self {
        Series { cos: BTreeMap::from([(0, value)]), sin: BTreeMap::new() }
    }

    /// value * cos(2 pi p j/n) for any whole p.
    fn add_cos(&mut self, p: i64, value: &F) -> Result<(), Trouble> {
        add(&mut self.cos, p.abs(), value)
    }

    /// value * sin(2 pi p j/n) for any whole p.
    fn add_sin(&mut self, p: i64, value: &F) -> Result<(), Trouble> {
        match p {
            0 => Ok(()),
            p if p < 0 => add(&mut self.sin, -p, &value.negated()),
            p => add(&mut self.sin, p, value),
        }
    }

    fn trimmed(mut self) -> Self {
        self.cos.retain(|_, value| !value.is_certainly_zero());
        self.sin.retain(|_, value| !value.is_certainly_zero());
        self
    }

    /// The value, where it doesn't depend on the index.
    fn as_constant(&self) -> Option<F> {
        let constant = self.sin.is_empty() && self.cos.keys().all(|p| *p == 0);
        constant.then(|| self.cos.get(&0).cloned().unwrap_or_else(|| F::whole(0)))
    }

    /// The sums over a ring of `n` points, at every frequency. `size` is n where it is a number; a free n must be larger than
    /// twice every p ([`Series::aliases_up_to`]).
    ///
    /// # Errors
    /// When the weights are not symmetric in j, as those of a mirrored ring are.
    pub fn sums(&self, n: &F, size: Option<usize>) -> Result<PerFrequency<F>, Trouble> {
        if !self.sin.is_empty() {
            return Err(Trouble::BeyondThisWorld("the weights of this ring are not the same at j and -j"));
        }
        let half = n.over(&F::whole(2))?;
        let mut sums = PerFrequency::same(F::whole(0));
        for (p, amplitude) in &self.cos {
            let p = usize::try_from(*p).map_err(|_| NO_WAVE)?;
            let folded = size.map_or(p, |n| (p % n).min((n - p % n) % n));
            let whole = folded == 0 || size.is_some_and(|n| 2 * folded == n);
            let term = amplitude.times(if whole { n } else { &half })?;
            let entry = sums.at.entry(folded).or_insert_with(|| F::whole(0));
            *entry = entry.plus(&term)?;
        }
        Ok(sums)
    }

    /// The largest n at which frequencies of this sum fall together.
    pub fn aliases_up_to(&self) -> usize {
        self.cos.keys().chain(self.sin.keys()).max().map_or(0, |p| 2 * usize::try_from(*p).unwrap_or(usize::MAX / 2))
    }
}

fn add<F: Field>(map: &mut BTreeMap<i64, F>, p: i64, value: &F) -> Result<(), Trouble> {
    let sum = match map.get(&p) {
        Some(own) => own.plus(value)?,
        None => value.clone(),
    };
    map.insert(p, sum);
    Ok(())
}

impl<F: Field> Field for Series<F> {
    const EXACT: bool = F::EXACT;

    fn rational(value: &RBig) -> Self {
        Series::constant(F::rational(value)).trimmed()
    }

    fn negated(&self) -> Self {
        let negated = |map: &BTreeMap<i64, F>| map.iter().map(|(p, value)| (*p, value.negated())).collect();
        Series { cos: negated(&self.cos), sin: negated(&self.sin) }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        let mut sum = self.clone();
        other.cos.iter().try_for_each(|(p, value)| sum.add_cos(*p, value))?;
        other.sin.iter().try_for_each(|(p, value)| sum.add_sin(*p, value))?;
        Ok(sum.trimmed())
    }

    /// By the addition theorems.
    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        let half = F::whole(1).over(&F::whole(2))?;
        let mut product = Series { cos: BTreeMap::new(), sin: BTreeMap::new() };
        for (p, a) in &self.cos {
            for (q, b) in &other.cos {
                let value = a.times(b)?.times(&half)?;
                product.add_cos(p - q, &value)?;
                product.add_cos(p + q, &value)?;
            }
            for (q, b) in &other.sin {
                let value = a.times(b)?.times(&half)?;
                product.add_sin(q + p, &value)?;
                product.add_sin(q - p, &value)?;
            }
        }
        for (p, a) in &self.sin {
            for (q, b) in &other.cos {
                let value = a.times(b)?.times(&half)?;
                product.add_sin(p + q, &value)?;
                product.add_sin(p - q, &value)?;
            }
            for (q, b) in &other.sin {
                let value = a.times(b)?.times(&half)?;
                product.add_cos(p - q, &value)?;
                product.add_cos(p + q, &value.negated())?;
            }
        }
        Ok(product.trimmed())
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        let divisor = other.as_constant().ok_or(NO_WAVE)?;
        self.times(&Series::constant(F::whole(1).over(&divisor)?))
    }

    fn is_certainly_zero(&self) -> bool {
        self.cos.is_empty() && self.sin.is_empty()
    }
}

/// A world over the indices of a ring: that of one point, with `j` free.
pub struct RingWorld<'a, W> {
    /// The world of one point.
    pub base: &'a W,
    /// The number of points, where it is a number.
    pub size: Option<usize>,
}

impl<W: World> RingWorld<'_, W> {
    /// The p of an angle's part 2 pi p j/n.
    fn wave(&self, angle: &Angle) -> Result<i64, Trouble> {
        let own = match self.size {
            Some(n) => &angle.per_j * RBig::from(n) + &angle.per_jn,
            None if angle.per_j.is_zero() => angle.per_jn.clone(),
            None => return Err(NO_WAVE),
        };
        let whole = if own.is_int() { i64::try_from(own.numerator().clone()).ok() } else { None };
        whole.filter(|p| p.unsigned_abs() <= MAX_WAVE).ok_or(NO_WAVE)
    }

    /// The sum cos_value * cos(2 pi p j/n) + sin_value * sin(2 pi p j/n).
    fn wave_sum(&self, p: i64, cos_value: &W::Value, sin_value: &W::Value) -> Result<Series<W::Value>, Trouble> {
        let mut series = Series { cos: BTreeMap::new(), sin: BTreeMap::new() };
        series.add_cos(p, cos_value)?;
        series.add_sin(p, sin_value)?;
        Ok(series.trimmed())
    }

    /// Whether the angle is zero at the start of the ring: then no sine is asked of the base.
    fn starts_at_zero(angle: &Angle) -> bool {
        angle.constant.is_zero() && angle.per_n.is_zero()
    }
}

/// The largest p of a wave cos(2 pi p j/n).
const MAX_WAVE: u64 = 1000;

impl<W: World> World for RingWorld<'_, W> {
    type Value = Series<W::Value>;

    fn name(&self, name: &str) -> Result<Self::Value, Trouble> {
        if name == "j" { Err(NO_WAVE) } else { Ok(Series::constant(self.base.name(name)?).trimmed()) }
    }

    fn pi(&self) -> Result<Self::Value, Trouble> {
        Ok(Series::constant(self.base.pi()?))
    }

    fn cos(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        let (p, start) = (self.wave(angle)?, angle.at_start());
        let zero = W::Value::whole(0);
        if Self::starts_at_zero(angle) {
            return self.wave_sum(p, &W::Value::whole(1), &zero);
        }
        let sine = if p == 0 { zero } else { self.base.sin(&start)?.negated() };
        self.wave_sum(p, &self.base.cos(&start)?, &sine)
    }

    fn sin(&self, angle: &Angle) -> Result<Self::Value, Trouble> {
        let (p, start) = (self.wave(angle)?, angle.at_start());
        let zero = W::Value::whole(0);
        if Self::starts_at_zero(angle) {
            return self.wave_sum(p, &zero, &W::Value::whole(1));
        }
        let cosine = if p == 0 { zero } else { self.base.cos(&start)? };
        self.wave_sum(p, &self.base.sin(&start)?, &cosine)
    }

    fn sqrt(&self, radicand: &Self::Value) -> Result<Self::Value, Trouble> {
        let radicand = radicand.as_constant().ok_or(NO_WAVE)?;
        Ok(Series::constant(self.base.sqrt(&radicand)?).trimmed())
    }
}

/// A number that may be another at finitely many frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct PerFrequency<F> {
    /// Its value at all other frequencies.
    pub general: F,
    /// Its value at k = +-p, by p >= 0.
    pub at: BTreeMap<usize, F>,
}

impl<F: Field> PerFrequency<F> {
    /// The same number at every frequency.
    pub fn same(value: F) -> Self {
        PerFrequency { general: value, at: BTreeMap::new() }
    }

    /// The value at the frequencies +-p; `None` stands for all that are not told apart.
    pub fn value(&self, p: Option<usize>) -> &F {
        p.and_then(|p| self.at.get(&p)).unwrap_or(&self.general)
    }

    fn joined(&self, other: &Self, join: impl Fn(&F, &F) -> Result<F, Trouble>) -> Result<Self, Trouble> {
        let keys: BTreeSet<usize> = self.at.keys().chain(other.at.keys()).copied().collect();
        let at = |p: usize| Ok((p, join(self.value(Some(p)), other.value(Some(p)))?));
        let at = keys.into_iter().map(at).collect::<Result<_, Trouble>>()?;
        Ok(PerFrequency { general: join(&self.general, &other.general)?, at })
    }
}

impl<F: Field> Field for PerFrequency<F> {
    const EXACT: bool = F::EXACT;

    fn rational(value: &RBig) -> Self {
        PerFrequency::same(F::rational(value))
    }

    fn negated(&self) -> Self {
        let at = self.at.iter().map(|(p, value)| (*p, value.negated())).collect();
        PerFrequency { general: self.general.negated(), at }
    }

    fn plus(&self, other: &Self) -> Result<Self, Trouble> {
        self.joined(other, F::plus)
    }

    fn times(&self, other: &Self) -> Result<Self, Trouble> {
        self.joined(other, F::times)
    }

    fn over(&self, other: &Self) -> Result<Self, Trouble> {
        self.joined(other, F::over)
    }

    fn is_certainly_zero(&self) -> bool {
        self.general.is_certainly_zero() && self.at.values().all(F::is_certainly_zero)
    }
}
