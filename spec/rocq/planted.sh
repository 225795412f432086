#!/usr/bin/env bash
# The reader of operations bites: in copies of the library's source, changes of an order, a constant, a comparison are
# planted one by one. After each, what is printed for Rocq is another text than exact/Operations.v, or the reader
# refuses. Usage: planted.sh READER, where READER is the program of proofs/operations.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
reader=$1
kernels=src/geom/kernel slabs=src/geom/slabs lanes=src/geom/lanes

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r --parents src/geom "$copy"

diff spec/rocq/exact/Operations.v <("$reader" "$copy") || { echo "planted: exact/Operations.v is not what the source says" >&2; exit 1; }

caught=0
# planted FILE FROM TO: one text for another, which must stand there once.
planted() {
    local file=$1 from=$2 to=$3 text
    text=$(< "$file")
    [[ $(grep -oF -- "$from" "$file" | wc -l) == 1 ]] || { echo "planted: $file does not say once: $from" >&2; exit 1; }
    printf '%s\n' "${text/"$from"/"$to"}" > "$copy/$file"
    # At the first difference `cmp` ends, and so the reader, which then says that nobody reads it.
    if "$reader" "$copy" 2> "$copy/refused" | cmp -s - spec/rocq/exact/Operations.v; then
        echo "planted: $to in $file is not seen" >&2
        exit 1
    fi
    if [[ -s $copy/refused ]] && ! grep -qF 'Broken pipe' "$copy/refused"; then
        echo "refused: $to ($(< "$copy/refused"))"
    else
        echo "another text: $to"
    fi
    cp "$file" "$copy/$file"
    caught=$((caught + 1))
}

# An order of additions, an order of factors, what is subtracted first, and from what.
planted $kernels/exact/filter.rs 'edges: [u, v, (det - u) - v]' 'edges: [u, v, (det - v) - u]'
planted $kernels/exact/filter.rs 'UNIT) * (d * e) * (c + e)' 'UNIT) * ((d * e) * (c + e))'
planted $kernels/exact/filter.rs 'let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);' 'let (e1, e2, s) = (v1 - v0, v2 - v0, v0 - o);'
planted $kernels/exact/sum.rs '(a - (sum - b_of_sum)) + (b - b_of_sum)' '(b - b_of_sum) + (a - (sum - b_of_sum))'
planted $kernels/exact/predicates.rs 'difference(a[k], b[k])' 'difference(b[k], a[k])'
# A fused multiplication and addition.
planted $kernels/exact/filter.rs '(error + x.abs() * self.det) * reciprocal.abs()' 'x.abs().mul_add(self.det, error) * reciprocal.abs()'
# One step of the reciprocal, here and there; and none for one of the two planes.
planted $slabs/directed.rs 'pub const STEPS: u32 = 2;' 'pub const STEPS: u32 = 1;'
planted $slabs/slabs64.rs 'pub const STRICT_STEPS: u32 = 3;' 'pub const STRICT_STEPS: u32 = 2;'
planted $slabs/directed.rs 'moved(-(STEPS as i32))' 'moved(0)'
# Constants.
planted $kernels/bounds.rs 'pub const SIGN: u32 = 2 * EDGE;' 'pub const SIGN: u32 = 2 * EDGE - 1;'
planted $kernels/bounds.rs 'pub const QUOTIENT_FACTOR: f64 = 5.0 / 4.0;' 'pub const QUOTIENT_FACTOR: f64 = 1.0;'
planted $kernels/exact/sum.rs '134_217_729.0' '134_217_728.0'
planted $kernels/exact/single.rs '(127 - 60) << 23' '(127 - 65) << 23'
planted $slabs/centred.rs '1.0 + 2.0 * f32::EPSILON' '1.0 + 1.0 * f32::EPSILON'
# u of the wrong type.
planted $kernels/exact/filter.rs 'const UNIT: f64 = f64::EPSILON / 2.0;' 'const UNIT: f64 = f32::EPSILON as f64 / 2.0;'
# A comparison, and its operands where a NaN tells them apart.
planted $kernels/exact/filter.rs '!(u >= -errors.sign && v >=' '!(u > -errors.sign && v >='
planted $kernels/exact/filter.rs 'u > errors.sign && v' 'u >= errors.sign && v'
planted $slabs/mod.rs 'near.cmple(far.yxwz())' 'near.cmplt(far.yxwz())'
planted $slabs/mod.rs 'lesser(other, t)' 'lesser(t, other)'
planted $slabs/mod.rs 'Vec4::select(a.cmplt(b), a, b)' 'Vec4::select(a.cmple(b), a, b)'
# The least of the greatest numbers, and single precision where there should be double.
planted src/geom/region.rs 'size.max_element()' 'size.y'
planted src/geom/region.rs 'aabb.hi.as_dvec3() - aabb.lo.as_dvec3()' '(aabb.hi - aabb.lo).as_dvec3()'
# Bounds of a ray within bounds, and what bounds of a distance decide.
planted $kernels/exact/filter.rs 'origin * (d + direction)' 'origin * d'
planted $kernels/bounds.rs 'pub const OFF: f64 = 6.0;' 'pub const OFF: f64 = 4.0;'
planted $kernels/exact/mod.rs 'tmin < near && near < tmax' 'tmin <= near && near < tmax'
planted $kernels/exact/mod.rs 'if tmin < near && far < tmax {' 'if tmin < near && near < tmax {'
planted src/geom/interval.rs 'if below >= 0.0 { lo }' 'if above >= 0.0 { lo }'
planted src/geom/interval.rs 'radius.next_up()' 'radius'
# Twice the digits: what is left out of a sum, its error, where a product is exact, what underflows, a sign, and a component.
planted src/geom/fine.rs 'if left == 0.0 && least == 0.0 {' 'if least == 0.0 {'
planted src/geom/fine.rs 'middle + least' 'middle'
planted src/geom/fine.rs 'const ERROR: f64 = power_of_two(-102);' 'const ERROR: f64 = power_of_two(-106);'
planted src/geom/fine.rs 'const EXACT: f64 = power_of_two(-900);' 'const EXACT: f64 = power_of_two(-1000);'
planted src/geom/fine.rs 'of_radii * UP + high.abs() * ERROR + UNDERFLOW' 'of_radii * UP + high.abs() * ERROR'
planted src/geom/fine.rs '(self.low.abs() + self.radius) * UP < self.high.abs()' '(self.low.abs() + self.radius) * UP <= self.high.abs()'
# Its quotients, hulls and roots: a divisor, a doubt, what is known, which is greater, a range, and a factor.
planted src/geom/fine.rs '/ least + step.abs()' '/ whole.high + step.abs()'
planted src/geom/fine.rs 'whole.radius / whole.high + f64::EPSILON' 'whole.radius / whole.high'
planted src/geom/fine.rs 'least > 0.0 && quotient.is_finite()' 'least >= 0.0 && quotient.is_finite()'
planted src/geom/fine.rs 'self.radius.max(reach)' 'reach'
planted src/geom/fine.rs 'self.radius <= self.high / 8.0' 'self.radius <= self.high / 2.0'
planted src/geom/fine.rs '(reach / r) / (4.0 * r)' '(reach / r) / (16.0 * r)'
# The determinants of them: an order, an end of the interval, and an end that is not moved.
planted $kernels/exact/fine.rs 'dot(&self.e2, &cross(&self.s, &self.e1))' 'dot(&self.e2, &cross(&self.e1, &self.s))'
planted $kernels/exact/fine.rs 'tmin < *t && *t < tmax' 'tmin <= *t && *t < tmax'
planted src/geom/vector.rs 'if below < 0.0 { lo.next_down() } else { lo } as f32' 'lo as f32'
planted $kernels/exact/fine.rs 'a[i] * b[j] - a[j] * b[i]' 'a[j] * b[i] - a[i] * b[j]'
planted $kernels/exact/fine.rs 'filter(|&k| d[k] != 0.0)' 'filter(|&k| d[k] > 0.0)'
# Lanes: planes, their sides, steps, a NaN, bits of a rank, a comparison.
planted $lanes/boxes.rs '(Self::pick(simd, y, side[1]) - origin[1])' '(Self::pick(simd, y, side[0]) - origin[1])'
planted $lanes/boxes.rs 'direction.cmplt(Vec4::ZERO)' 'direction.cmple(Vec4::ZERO)'
planted $lanes/boxes.rs 'far: splat(simd, far.truncate())' 'far: splat(simd, near.truncate())'
planted $lanes/boxes.rs 'lesser(far_z, V::splat(simd, end))' 'lesser(V::splat(simd, end), far_z)'
planted $lanes/boxes.rs '(1 << 31) - A as u32' '(1 << 31) - 2 * A as u32'
planted $lanes/boxes.rs '.simd_le(leave)' '.simd_lt(leave)'
# Filters of triangles: bounds, sizes, rounding up, an order, and a sign.
planted $lanes/triangles.rs 'pub const DETERMINANT: u32 = 40;' 'pub const DETERMINANT: u32 = 34;'
planted $lanes/triangles.rs '(127 - 40) << 23' '(127 - 60) << 23'
planted $lanes/triangles.rs '(far + reach).max(MIN_EDGE)' 'far.max(reach).max(MIN_EDGE)'
planted $lanes/triangles.rs 'rounded.next_up()' 'rounded'
planted $lanes/triangles.rs 'a[1] * b[2] - a[2] * b[1]' 'a[2] * b[1] - a[1] * b[2]'
planted $lanes/triangles.rs 't.turned(det)' 't.turned(least)'
planted $lanes/triangles.rs 'least.simd_lt(-delta) & ' 'least.simd_lt(-delta) | '
planted $lanes/block.rs '(v2 - v0).abs()' '(v2 - v1).abs()'
# The nearest point of a triangle and its bounds: a constant, two comparisons, and two orders.
planted src/geom/nearest.rs 'const MARGIN: f64 = 64.0 * UNIT;' 'const MARGIN: f64 = 32.0 * UNIT;'
planted src/geom/nearest.rs 'd3 >= 0.0 && d4 <= d3' 'd3 > 0.0 && d4 <= d3'
planted src/geom/nearest.rs 'if length > SHORT' 'if length >= SHORT'
planted src/geom/nearest.rs 'length * (1.0 + 8.0 * UNIT) + margin' '(length + margin) * (1.0 + 8.0 * UNIT)'
planted src/geom/nearest.rs 'let all = of_a + of_b + of_c;' 'let all = of_a + (of_b + of_c);'
echo "operations: $caught planted changes are seen"
