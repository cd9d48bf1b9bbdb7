//! Bits of 512 lanes as the processor computes with them.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{
    __m256i, __m512i, _mm256_and_si256, _mm256_loadu_si256, _mm256_or_si256, _mm256_set1_epi64x,
    _mm256_storeu_si256, _mm256_testz_si256, _mm256_xor_si256, _mm512_and_si512,
    _mm512_loadu_si512, _mm512_or_si512, _mm512_set1_epi64, _mm512_storeu_si512,
    _mm512_ternarylogic_epi64, _mm512_test_epi64_mask, _mm512_xor_si512,
};

use super::lanes::Lane;

/// One bit in all lanes.
pub trait Vector: Copy {
    /// The bits of an array.
    fn load(lane: &Lane) -> Self;
    /// Into an array.
    fn store(self, lane: &mut Lane);
    /// The same bit in all lanes.
    fn of(bit: bool) -> Self;
    /// Set where both are.
    #[must_use]
    fn and(self, other: Self) -> Self;
    /// Set where either is.
    #[must_use]
    fn or(self, other: Self) -> Self;
    /// Set where just one is.
    #[must_use]
    fn xor(self, other: Self) -> Self;

    /// True when it is set in any lane.
    fn any(self) -> bool;

    /// Set where this is clear.
    #[inline(always)]
    #[must_use]
    fn not(self) -> Self {
        self.xor(Self::of(true))
    }

    /// `then` where this is set, else `otherwise`.
    #[inline(always)]
    #[must_use]
    fn choose(self, then: Self, otherwise: Self) -> Self {
        otherwise.xor(then.xor(otherwise).and(self))
    }
}

impl Vector for Lane {
    #[inline(always)]
    fn load(lane: &Lane) -> Self {
        *lane
    }

    #[inline(always)]
    fn store(self, lane: &mut Lane) {
        *lane = self;
    }

    #[inline(always)]
    fn of(bit: bool) -> Self {
        [if bit { u64::MAX } else { 0 }; 8]
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        std::array::from_fn(|word| self[word] & other[word])
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        std::array::from_fn(|word| self[word] | other[word])
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        std::array::from_fn(|word| self[word] ^ other[word])
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.iter().fold(0, |any, word| any | word) != 0
    }
}

/// One AVX-512 register. Only to be used on a processor that has AVX-512F.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bits512(__m512i);

/// The truth table of "then where set, else otherwise" for the instruction with three operands.
#[cfg(target_arch = "x86_64")]
const CHOOSE: i32 = 0xca;

// SAFETY (of every block below): instructions of AVX-512F on whole registers; the loads and stores
// touch the 64 bytes of one `Lane` and need no alignment. `Lanes` asks the processor before it
// computes with this type.
#[cfg(target_arch = "x86_64")]
impl Vector for Bits512 {
    #[inline(always)]
    fn load(lane: &Lane) -> Self {
        Self(unsafe { _mm512_loadu_si512(lane.as_ptr().cast()) })
    }

    #[inline(always)]
    fn store(self, lane: &mut Lane) {
        unsafe { _mm512_storeu_si512(lane.as_mut_ptr().cast(), self.0) }
    }

    #[inline(always)]
    fn of(bit: bool) -> Self {
        Self(unsafe { _mm512_set1_epi64(-i64::from(bit)) })
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(unsafe { _mm512_and_si512(self.0, other.0) })
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(unsafe { _mm512_or_si512(self.0, other.0) })
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        Self(unsafe { _mm512_xor_si512(self.0, other.0) })
    }

    #[inline(always)]
    fn any(self) -> bool {
        unsafe { _mm512_test_epi64_mask(self.0, self.0) != 0 }
    }

    #[inline(always)]
    fn choose(self, then: Self, otherwise: Self) -> Self {
        Self(unsafe { _mm512_ternarylogic_epi64::<CHOOSE>(self.0, then.0, otherwise.0) })
    }
}

/// Two AVX2 registers. Only to be used on a processor that has AVX2.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bits256([__m256i; 2]);

// SAFETY (of every block below): instructions of AVX2 on whole registers; the loads and stores touch
// the two halves of one `Lane` and need no alignment. `Lanes` asks the processor before it computes
// with this type.
#[cfg(target_arch = "x86_64")]
impl Vector for Bits256 {
    #[inline(always)]
    fn load(lane: &Lane) -> Self {
        let [low, high] = [&lane[..4], &lane[4..]].map(<[u64]>::as_ptr);
        Self(unsafe { [_mm256_loadu_si256(low.cast()), _mm256_loadu_si256(high.cast())] })
    }

    #[inline(always)]
    fn store(self, lane: &mut Lane) {
        let (low, high) = lane.split_at_mut(4);
        unsafe {
            _mm256_storeu_si256(low.as_mut_ptr().cast(), self.0[0]);
            _mm256_storeu_si256(high.as_mut_ptr().cast(), self.0[1]);
        }
    }

    #[inline(always)]
    fn of(bit: bool) -> Self {
        let half = unsafe { _mm256_set1_epi64x(-i64::from(bit)) };
        Self([half, half])
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        Self(unsafe { [_mm256_and_si256(a, c), _mm256_and_si256(b, d)] })
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        Self(unsafe { [_mm256_or_si256(a, c), _mm256_or_si256(b, d)] })
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        Self(unsafe { [_mm256_xor_si256(a, c), _mm256_xor_si256(b, d)] })
    }

    #[inline(always)]
    fn any(self) -> bool {
        let [low, high] = self.0;
        let any = unsafe { _mm256_or_si256(low, high) };
        unsafe { _mm256_testz_si256(any, any) == 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::random_design::Dice;

    /// Every vector does what the array does; kinds the processor lacks are left out.
    fn agrees_with_the_array<V: Vector>() {
        let mut dice = Dice(8);
        let mut lane = || std::array::from_fn(|_| dice.roll());
        let lanes: [Lane; 3] = [lane(), lane(), lane()];
        let [a, b, c] = lanes;
        let [first, second, third] = lanes.map(|lane| V::load(&lane));
        let bits = |vector: V| {
            let mut lane = [0; 8];
            vector.store(&mut lane);
            lane
        };
        assert_eq!(bits(first.and(second)), a.and(b));
        assert_eq!(bits(first.or(second)), a.or(b));
        assert_eq!(bits(first.xor(second)), a.xor(b));
        assert_eq!(bits(first.not()), a.map(|word| !word));
        assert_eq!(bits(first.choose(second, third)), a.choose(b, c));
        assert_eq!(bits(V::of(true)), [u64::MAX; 8]);
        assert!(!V::of(false).any());
        assert!((0..8).all(|word| {
            let mut lane = [0; 8];
            lane[word] = 1 << dice.below(64);
            V::load(&lane).any()
        }));
        assert_eq!(a.choose(b, c)[3], (a[3] & b[3]) | (!a[3] & c[3]));
    }

    #[test]
    fn vectors_agree() {
        agrees_with_the_array::<Lane>();
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                agrees_with_the_array::<Bits256>();
            }
            if is_x86_feature_detected!("avx512f") {
                agrees_with_the_array::<Bits512>();
            }
        }
    }
}
