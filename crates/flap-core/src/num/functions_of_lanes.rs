//! The functions of `Real` for lanes, declared by one line.

/// The functions of `Real` for `Lanes`, by the polynomials of `functions`.
macro_rules! functions_of_lanes {
    () => {
        $crate::num::functions_of_lanes::functions_of_lanes!(
            sin, exp, exp_m1, ln, ln_1p, round_ties_even, exp_of_ordinary, exp_m1_of_ordinary, ln_of_normal,
            ln_1p_of_normal
        );

        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            $crate::num::functions::sin_cos(self)
        }

        #[inline(always)]
        fn look_up<const N: usize>(self, table: impl Fn(f64) -> [f64; N]) -> [Self; N] {
            let mut out = [self; N];
            for lane in 0..<Self as $crate::num::Lanes>::LANES {
                let entries = table($crate::num::Lanes::lane(self, lane));
                for i in 0..N {
                    $crate::num::Lanes::set_lane(&mut out[i], lane, entries[i]);
                }
            }
            out
        }
    };
    ($($function:ident),*) => {
        $(
            #[inline(always)]
            fn $function(self) -> Self {
                $crate::num::functions::$function(self)
            }
        )*
    };
}

pub(super) use functions_of_lanes;
