#!/usr/bin/env bash
# The reader of operations bites: in copies of the library's source, changes of an order, a constant, a comparison are
# planted one by one. After each, what is printed for Rocq is another text than exact/Operations.v, or the reader
# refuses. Usage: planted.sh READER, where READER is the program of proofs/operations.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
reader=$1
kernels=src/geom/kernel slabs=src/geom/slabs

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r --parents src/geom "$copy"

diff spec/rocq/exact/Operations.v <("$reader" "$copy") || { echo "planted: exact/Operations.v is not what the source says" >&2; exit 1; }

caught=0
# planted FILE FROM TO: one text for another, which must stand there once.
planted() {
    local file=$1 from=$2 to=$3 text printed
    text=$(< "$file")
    [[ $(grep -oF -- "$from" "$file" | wc -l) == 1 ]] || { echo "planted: $file does not say once: $from" >&2; exit 1; }
    printf '%s\n' "${text/"$from"/"$to"}" > "$copy/$file"
    if printed=$("$reader" "$copy" 2> "$copy/refused"); then
        if diff -q spec/rocq/exact/Operations.v <(printf '%s\n' "$printed") > /dev/null; then
            echo "planted: $to in $file is not seen" >&2
            exit 1
        fi
        echo "another text: $to"
    else
        echo "refused: $to ($(< "$copy/refused"))"
    fi
    cp "$file" "$copy/$file"
    caught=$((caught + 1))
}

# An order of additions, an order of factors, and the edge that is subtracted first.
planted $kernels/exact/filter.rs 'edges: [u, v, (det - u) - v]' 'edges: [u, v, (det - v) - u]'
planted $kernels/exact/filter.rs 'UNIT) * (d * e) * (c + e)' 'UNIT) * ((d * e) * (c + e))'
planted $kernels/exact/filter.rs 'let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);' 'let (e1, e2, s) = (v1 - v0, v2 - v0, v0 - o);'
planted $kernels/exact/sum.rs '(a - (sum - b_of_sum)) + (b - b_of_sum)' '(b - b_of_sum) + (a - (sum - b_of_sum))'
planted $kernels/exact/predicates.rs 'sum.add_product(a[i], b[j], d[k]);' 'sum.add_product(a[j], b[i], d[k]);'
# A fused multiplication and addition.
planted $kernels/exact/filter.rs '(error + x.abs() * errors.det) * reciprocal.abs()' 'x.abs().mul_add(errors.det, error) * reciprocal.abs()'
# One step of the reciprocal, here and there; and none for one of the two planes.
planted $slabs/directed.rs 'pub const STEPS: u32 = 2;' 'pub const STEPS: u32 = 1;'
planted $slabs/wide.rs 'pub const STRICT_STEPS: u32 = 3;' 'pub const STRICT_STEPS: u32 = 2;'
planted $slabs/directed.rs 'moved(-(STEPS as i32))' 'moved(0)'
# Constants.
planted $kernels/bounds.rs 'pub const SIGN: u32 = 2 * EDGE;' 'pub const SIGN: u32 = 2 * EDGE - 1;'
planted $kernels/bounds.rs 'pub const QUOTIENT_FACTOR: f64 = 5.0 / 4.0;' 'pub const QUOTIENT_FACTOR: f64 = 1.0;'
planted $kernels/exact/sum.rs '134_217_729.0' '134_217_728.0'
planted $kernels/exact/double.rs 'power_of_two(-200)..=' 'power_of_two(-280)..='
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
echo "operations: $caught planted changes are seen"
