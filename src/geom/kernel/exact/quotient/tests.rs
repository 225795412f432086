use super::*;

/// The distance of a plane that is `far` away, in steps of `d`.
fn ratio(far: f64, d: f64) -> Ratio {
    Ratio::distance(&[DVec3::ZERO, DVec3::X, DVec3::Y], DVec3::new(0.25, 0.25, -far), DVec3::Z * d)
}

#[test]
fn doubles_are_rounded_where_nothing_underflows() {
    let power = |exponent: i32| 2f64.powi(exponent);
    for sign in [1.0, -1.0] {
        let nearest = |far: f64, d: f64| ratio(sign * far, d).nearest_double().map(|t| sign * t);
        assert_eq!(nearest(1.0, 3.0), Some(1.0 / 3.0));
        assert_eq!(nearest(0.0, 3.0), Some(0.0));
        assert_eq!(nearest(power(100), power(-150)), Some(power(250)));
        assert_eq!(nearest(power(100).next_up(), power(-150)), None);
        assert_eq!(nearest(power(-150), power(100)), Some(power(-250)));
        assert_eq!(nearest(power(-150).next_down(), power(100)), None);
    }
}

/// Hits at middles between floats, exactly and all but: nearer than the first quotient shows.
#[test]
fn ties_of_floats_go_to_even() {
    for odd in [0, 1, 2, 3u32] {
        // The plane is at 2^24 + 2 odd, and 4 above that at the second corner. At (0, 0) the weight of that is a
        // quarter: the distance ends in 1, and floats are 2 apart.
        let low = 2f64.powi(24) + 2.0 * f64::from(odd);
        let [a, b, c] = [[-1.0, -1.0, low], [3.0, -1.0, low + 4.0], [-1.0, 3.0, low]].map(DVec3::from);
        for nudge in [0.0, 2f64.powi(-30), -2f64.powi(-30)] {
            let is_up = if nudge == 0.0 { odd % 2 == 1 } else { nudge > 0.0 };
            let expected = low + if is_up { 2.0 } else { 0.0 };
            for corners in [[a, b, c], [a, c, b]] {
                let found = distance(&corners, DVec3::X * nudge, DVec3::Z, [0.0, f32::INFINITY]);
                assert_eq!(found.map(f64::from), Some(expected), "{odd} {nudge}");
                // Behind the origin.
                let found = distance(&corners, DVec3::X * nudge, -DVec3::Z, [f32::NEG_INFINITY.next_up(), 0.0]);
                assert_eq!(found.map(f64::from), Some(-expected), "{odd} {nudge}");
            }
        }
    }
}
