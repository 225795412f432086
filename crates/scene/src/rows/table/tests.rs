use super::*;
use crate::tests::Random;

/// Writes hits of rays like `trace`.
pub(in crate::rows) fn write_hits<F: Float>(
    writer: impl io::Write,
    hits: impl ExactSizeIterator<Item = Option<(u32, F, F, F)>>,
    format: Format,
) -> io::Result<()> {
    let number = |name| Column::Number(name, f64::NAN);
    let columns = [Column::Integer("prim"), Column::Number("t", f64::INFINITY), number("u"), number("v")];
    let row = |hit: Option<(u32, F, F, F)>| match hit {
        Some((prim, t, u, v)) => [Cell::Integer(prim.into()), Cell::Number(t), Cell::Number(u), Cell::Number(v)],
        None => [Cell::Integer(-1), Cell::Missing, Cell::Missing, Cell::Missing],
    };
    write_table(writer, columns, hits.map(row), format)
}

#[test]
fn hits_read_back_bit_for_bit() {
    let mut random = Random(11);
    let mut hits = vec![None, Some((u32::MAX, 0.0, -0.0, f32::MIN_POSITIVE / 8.0)), Some((0, f32::MAX, 1.0, 1e-7))];
    for _ in 0..5_000 {
        let [t, u, v] = std::array::from_fn(|_| f32::from_bits(random.next() as u32 & 0xBF7F_FFFF));
        hits.push((random.below(4) != 0).then_some((random.next() as u32, t, u, v)));
    }
    let mut text = Vec::new();
    write_hits(&mut text, hits.iter().copied(), Format::Csv).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.starts_with("prim,t,u,v\n-1,,,\n4294967295,0.0,-0.0,1.469368e-39\n"), "{text:.80}");

    let lines: Vec<&str> = text.lines().skip(1).collect();
    assert_eq!(lines.len(), hits.len());
    for (line, hit) in lines.into_iter().zip(hits) {
        let columns: Vec<&str> = line.split(',').collect();
        let [prim, numbers @ ..] = &columns[..] else { panic!("{line}") };
        match hit {
            None => assert_eq!(columns, ["-1", "", "", ""]),
            Some((index, t, u, v)) => {
                assert_eq!(prim.parse(), Ok(index));
                let bits: Vec<u32> = numbers.iter().map(|n| n.parse::<f32>().unwrap().to_bits()).collect();
                assert_eq!(bits, [t, u, v].map(f32::to_bits), "{line}");
            }
        }
    }
}

#[test]
fn a_failing_writer_is_reported() {
    for format in Format::ALL {
        let mut full = [0; 20];
        assert!(write_hits(&mut full[..], std::iter::repeat_n(None::<(u32, f32, f32, f32)>, 10), format).is_err());
    }
}

#[test]
fn hits_are_written_in_all_formats() {
    let hits = [Some((3, 0.1, 0.25, f32::MIN_POSITIVE / 8.0)), None];
    let write = |format| {
        let mut bytes = Vec::new();
        write_hits(&mut bytes, hits.into_iter(), format).unwrap();
        bytes
    };
    let lines = "{\"prim\":3,\"t\":0.1,\"u\":0.25,\"v\":1.469368e-39}\n\
                 {\"prim\":-1,\"t\":null,\"u\":null,\"v\":null}\n";
    assert_eq!(String::from_utf8(write(Format::JsonLines)).unwrap(), lines);
    let array = write(Format::Npy);
    let rows = array.len() - 2 * 20;
    assert!(rows.is_multiple_of(64) && array[rows - 1] == b'\n');
    assert_eq!(usize::from(u16::from_le_bytes([array[8], array[9]])) + 10, rows);
    let header = String::from_utf8_lossy(&array[10..rows]).into_owned();
    let said = "{'descr': [('prim', '<i8'), ('t', '<f4'), ('u', '<f4'), ('v', '<f4')], 'fortran_order': False, \
                'shape': (2,), }";
    assert_eq!(header.trim(), said);
    assert_eq!(array[rows..rows + 12], [&3_i64.to_le_bytes()[..], &0.1_f32.to_le_bytes()].concat());
    assert_eq!(array[rows + 20..rows + 32], [&(-1_i64).to_le_bytes()[..], &f32::INFINITY.to_le_bytes()].concat());
}

#[test]
fn words_and_missing_values_are_written_in_all_formats() {
    let columns = [Column::Word("place", 4), Column::Integer("count"), Column::Number("d", f64::INFINITY)];
    let rows = [
        [Cell::Word("edge"), Cell::Integer(-7), Cell::Number(0.5_f64)],
        [Cell::Word("in"), Cell::Missing, Cell::Missing],
    ];
    let write = |format| {
        let mut bytes = Vec::new();
        write_table(&mut bytes, columns, rows.into_iter(), format).unwrap();
        bytes
    };
    assert_eq!(write(Format::Csv), b"place,count,d\nedge,-7,0.5\nin,,\n");
    let lines = "{\"place\":\"edge\",\"count\":-7,\"d\":0.5}\n{\"place\":\"in\",\"count\":null,\"d\":null}\n";
    assert_eq!(String::from_utf8(write(Format::JsonLines)).unwrap(), lines);
    let array = write(Format::Npy);
    let word = |word: &str| word.chars().flat_map(|letter| u32::from(letter).to_le_bytes()).collect::<Vec<_>>();
    let first = [&word("edge")[..], &(-7_i64).to_le_bytes(), &0.5_f64.to_le_bytes()].concat();
    let second = [&word("in\0\0")[..], &(-1_i64).to_le_bytes(), &f64::INFINITY.to_le_bytes()].concat();
    assert!(array.ends_with(&[first, second].concat()));
    assert!(array.windows(28).any(|it| it == b"[('place', '<U4'), ('count',"));
}
