use super::table::tests::write_hits;
use super::*;
use crate::tests::{Folder, Random};
use glam::{DVec3, Vec3};
use stackless_bvh::geom::Ray;

fn read(text: &str) -> Result<Vec<Ray>, RowFileError> {
    read_rows_from::<Ray>(text.as_bytes(), "rays.csv", Format::Csv).map(|loaded| loaded.rows)
}

fn refusal(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

#[test]
fn names_blank_lines_and_comments_are_skipped() {
    let text =
        "# two rays\n\n ox,oy,oz,dx,dy,dz,tmin,tmax\r\n1,2,3,0,0,-1,0,inf\r\n\n# last\n .5, -1.,+2e3,1,0,0, 0.25,4";
    let rays = read(text).unwrap();
    assert_eq!(
        rays,
        [
            Ray::new(Vec3::new(1.0, 2.0, 3.0), Vec3::NEG_Z).unwrap(),
            Ray::within(Vec3::new(0.5, -1.0, 2000.0), Vec3::X, 0.25, 4.0).unwrap(),
        ]
    );
    assert_eq!(read(&text.replace("ox,oy,oz,dx,dy,dz,tmin,tmax", "#")).unwrap(), rays);
    // For all line ends and all sizes of the reader's buffer.
    let plain = text.replace("\r\n", "\n");
    for end in ["\n", "\r", "\r\n", "\r\r\n"] {
        for mark in ["", "\u{feff}"] {
            let text = format!("{mark}{}", plain.replace('\n', end));
            for capacity in [1, 2, 7, 4096] {
                let reader = BufReader::with_capacity(capacity, text.as_bytes());
                assert_eq!(read_rows_from::<Ray>(reader, "rays.csv", Format::Csv).unwrap().rows, rays, "{text:?}");
            }
        }
    }
    assert_eq!(refusal("#\r\n#\r#\n1\r"), read("\n\n\n1").unwrap_err().to_string());
}

#[test]
fn a_line_without_end_is_refused_before_memory_is_gone() {
    let endless = BufReader::new(io::repeat(b'0'));
    let message = read_rows_from::<Ray>(endless, "rays.csv", Format::Csv).unwrap_err().to_string();
    assert_eq!(message, "rays.csv: line 1: more than 4096 bytes, expected a line of ox,oy,oz,dx,dy,dz,tmin,tmax");
    let long = |length: usize| format!("{}0,0,0,0,0,1,0,1\n", " ".repeat(length - 15));
    assert_eq!(read(&long(4096)).unwrap().len(), 1);
    assert!(matches!(read(&long(4097)), Err(RowFileError::Line { number: 1, fault: RowFault::Length(..), .. })));
}

#[test]
fn each_error_names_line_and_column() {
    let names = "ox,oy,oz,dx,dy,dz,tmin,tmax";
    let cases = [
        ("", format!("no rays, expected at least one line of {names}")),
        ("# none\n\n", format!("no rays, expected at least one line of {names}")),
        (names, format!("no rays, expected at least one line of {names}")),
        ("\n0,0,0,0,0,1,0\n", format!("line 2: 7 columns, expected 6 or 8: {names}")),
        ("0,0,0,0,0,1,0,1\n0,0,0,0,0,1\n", format!("line 2: 6 columns, expected 8 as above: {names}")),
        ("0,0,0,0,0,1\n0,0,0,0,0,1,0,1\n", format!("line 2: 8 columns, expected 6 as above: {names}")),
        ("0,0,0,0,0,1,0,1,\n", format!("line 1: 9 columns, expected 6 or 8: {names}")),
        (
            "oy,ox,oz,dx,dy,dz,tmin,tmax\n",
            "line 1: column ox: found \"oy\", expected a finite number in single precision".into(),
        ),
        ("0,0,0,0,0,1,0,\n", "line 1: column tmax: found \"\", expected a number or inf in single precision".into()),
        (
            "0,0,0,0,0,1,0,nan\n",
            "line 1: column tmax: found \"nan\", expected a number or inf in single precision".into(),
        ),
        (
            "0,0,0,0,0,1,0,-inf\n",
            "line 1: column tmax: found \"-inf\", expected a number or inf in single precision".into(),
        ),
        (
            "0,0,0,0,0,1,inf,inf\n",
            "line 1: column tmin: found \"inf\", expected a finite number in single precision".into(),
        ),
        (
            "0,0,nan,0,0,1,0,1\n",
            "line 1: column oz: found \"nan\", expected a finite number in single precision".into(),
        ),
        (
            "0,0,0,1e39,0,1,0,1\n",
            "line 1: column dx: found \"1e39\", expected a finite number in single precision".into(),
        ),
        (
            "0,0,0,0,0,1;0,0,1\n",
            "line 1: column dz: found \"1;0\", expected a finite number in single precision".into(),
        ),
        ("0,0,0,0,0,-0,0,1\n", "line 1: direction is zero".into()),
        ("0,0,0,0,0,1,-1,1\n", "line 1: tmin -1 is negative".into()),
        ("0,0,0,0,0,1,0,1\n0,0,0,0,0,1,2,1\n", "line 2: tmin 2 is greater than tmax 1".into()),
    ];
    for (text, message) in cases {
        assert_eq!(refusal(text), format!("rays.csv: {message}"), "{text}");
    }
    let twice = format!("{names}\n{names}\n");
    assert_eq!(
        refusal(&twice),
        "rays.csv: line 2: column ox: found \"ox\", expected a finite number in single precision"
    );
    assert!(read_rows_from::<Ray>(&b"0,0,0,0,0,1,0,\xFF\n"[..], "rays.csv", Format::Csv).is_err());
}

#[test]
fn a_missing_file_is_named() {
    let folder = Folder::new("rays");
    let path = folder.file("missing.csv");
    let message = read_rows::<Ray>(&path, Format::Csv).unwrap_err().to_string();
    assert!(message.starts_with(&format!("{}: cannot be read: ", path.display())), "{message}");
    std::fs::write(&path, "0,0,0,0,0,1,0,1\n").unwrap();
    assert_eq!(read_rows::<Ray>(&path, Format::Csv).unwrap().rows.len(), 1);
}

#[test]
fn rays_read_back_bit_for_bit() {
    let mut random = Random(7);
    let mut float = || loop {
        let value = f32::from_bits(random.next() as u32);
        if value.is_finite() {
            return value;
        }
    };
    for _ in 0..2_000 {
        let origin = Vec3::new(float(), float(), float());
        let direction = Vec3::new(float(), float(), float());
        let (a, b) = (float().abs(), float().abs());
        let ray = Ray::within(origin, direction, a.min(b), a.max(b)).unwrap();
        let [o, d] = [origin, direction].map(|v| format!("{},{:?},{:e}", v.x, v.y, v.z));
        let text = format!("{o},{d},{},{:?}\n", ray.tmin(), ray.tmax());
        assert_eq!(format!("{:?}", read(&text).unwrap()), format!("{:?}", [ray]));
    }
}

/// Returns a ray in each format, with and without its interval.
fn in_all_formats() -> Vec<(Format, Vec<u8>)> {
    let numbers = [1.0, 2.0, 3.0, 0.5, 0.0, -1.0, 0.0, f64::INFINITY];
    let doubles = |columns: usize| numbers[..columns].iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let floats = |columns: usize| numbers[..columns].iter().flat_map(|&x| (x as f32).to_le_bytes()).collect::<Vec<_>>();
    let text = |format, text: &str| (format, text.as_bytes().to_vec());
    vec![
        text(Format::Csv, "1,2,3,.5,0,-1\n"),
        text(Format::Csv, "ox,oy,oz,dx,dy,dz\n1,2,3,.5,0,-1\n"),
        text(Format::Csv, "1,2,3,.5,0,-1,0,inf\n"),
        text(Format::JsonLines, "# one\n{\"origin\":[1,2,3],\"direction\":[0.5,0,-1]}\n"),
        text(Format::JsonLines, "{\"direction\":[0.5,0,-1],\"origin\":[1,2,3],\"tmin\":0.0,\"tmax\":null}"),
        (Format::Npy, array("<f8", 8, doubles(8))),
        (Format::Npy, array("<f8", 6, doubles(6))),
        (Format::Npy, array("<f4", 8, floats(8))),
        (Format::Npy, array("<f4", 6, floats(6))),
    ]
}

/// Encodes a `NumPy` array of one row.
fn array(descr: &str, columns: usize, bytes: Vec<u8>) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': (1, {columns}), }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [&b"\x93NUMPY\x01\x00"[..], &length, header.as_bytes(), &bytes].concat()
}

#[test]
fn all_formats_hold_the_same_ray() {
    let ray = Ray::new(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.5, 0.0, -1.0)).unwrap();
    for (format, bytes) in in_all_formats() {
        let read = read_rows_from::<Ray>(&bytes[..], "rays", format).unwrap();
        assert_eq!((&read.rows[..], read.note("rays".as_ref(), 1.0)), (&[ray][..], None), "{}", bytes.escape_ascii());
    }
}

#[test]
fn doubles_are_read_as_they_are_and_written_so() {
    let ray =
        Ray::within(DVec3::new(0.1, 6_400_000.3, -1e-200), DVec3::new(1.0, 1.0 / 3.0, 1e300), 0.1, 1e308).unwrap();
    let [o, d] = [ray.origin(), ray.direction()];
    let numbers = [o.x, o.y, o.z, d.x, d.y, d.z, ray.tmin(), ray.tmax()];
    let csv = numbers.map(|x| format!("{x:?}")).join(",");
    let json = format!(
        "{{\"origin\":[{:?},{:?},{:?}],\"direction\":[{:?},{:?},{:?}],\"tmin\":{:?},\"tmax\":{:?}}}",
        o.x, o.y, o.z, d.x, d.y, d.z, numbers[6], numbers[7]
    );
    let bytes = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    // All decimals except 1 are rounded.
    let files = [
        (Format::Csv, csv.into_bytes(), 7),
        (Format::JsonLines, json.into_bytes(), 7),
        (Format::Npy, array("<f8", 8, bytes), 0),
    ];
    for (format, bytes, rounded) in files {
        let read = read_rows_from::<Ray<DVec3>>(&bytes[..], "rays", format).unwrap();
        assert_eq!((read.rows[0], read.rounding.numbers, read.rounding.rounded), (ray, 8, rounded), "{format}");
    }
    let hits = [Some((7, 0.1, 1.0 / 3.0, 1e-300)), None];
    let written = |format| {
        let mut file = Vec::new();
        write_hits(&mut file, hits.into_iter(), format).unwrap();
        file
    };
    assert_eq!(written(Format::Csv), b"prim,t,u,v\n7,0.1,0.3333333333333333,1e-300\n-1,,,\n");
    let npy = written(Format::Npy);
    assert!(npy.windows(12).any(|it| it == b"('t', '<f8')"));
    assert_eq!(npy[npy.len() - 64..][8..16], 0.1_f64.to_le_bytes());
}

/// For example, 1.000000059604644775391 is above the midpoint of two floats, and its nearest double is the midpoint.
#[test]
fn text_is_rounded_once() {
    let number = "1.000000059604644775391";
    let lines = [
        (Format::Csv, format!("{number},0,0,1,0,0")),
        (Format::JsonLines, format!("{{\"origin\":[{number},0,0],\"direction\":[1,0,0]}}")),
    ];
    for (format, line) in lines {
        let read = read_rows_from::<Ray>(line.as_bytes(), "rays", format).unwrap();
        assert_eq!(read.rows[0].origin().x, 1.0_f32.next_up(), "{format}");
    }
}

#[test]
fn doubles_that_are_rounded_are_counted() {
    let numbers: Vec<u8> =
        [0.1, 0.0, -3.0, 1.0, f64::from(0.1_f32), 1.0 / 3.0].iter().flat_map(|x: &f64| x.to_le_bytes()).collect();
    let read = read_rows_from::<Ray>(&array("<f8", 6, numbers)[..], "rays", Format::Npy).unwrap();
    let note = "r.npy: 2 of 6 numbers were rounded to single precision, by at most 9.4e-9 of the scene's size";
    assert_eq!(read.note("r.npy".as_ref(), 1.0).unwrap(), note);
}

#[test]
fn arrays_and_lines_that_are_cut_or_changed_are_refused_in_one_line() {
    for (format, bytes) in in_all_formats() {
        for end in 0..bytes.len() {
            // Truncated text may lack its last line feed, or the end of its last number.
            let read = read_rows_from::<Ray>(&bytes[..end], "rays", format);
            assert!(format != Format::Npy || read.is_err(), "{end}");
            let message = read.map_or_else(|error| error.to_string(), |_| String::new());
            assert!(!message.contains('\n') && message.len() < 400, "{message}");
        }
        for at in 0..bytes.len() {
            for changed in [0, 0x20, 0x7f, 0xff] {
                let mut bytes = bytes.clone();
                bytes[at] = changed;
                let message =
                    read_rows_from::<Ray>(&bytes[..], "rays", format).map_or_else(|e| e.to_string(), |_| String::new());
                assert!(!message.contains('\n') && message.len() < 400, "{message}");
            }
        }
    }
}

#[test]
fn errors_of_arrays_and_objects_say_what_was_expected() {
    let refusal = |format, bytes: &[u8]| read_rows_from::<Ray>(bytes, "rays", format).unwrap_err().to_string();
    let (_, good) = in_all_formats().swap_remove(5);
    let changed = |from: &str, to: &str| {
        let text = String::from_utf8(good.iter().map(|&byte| byte & 0x7f).collect()).unwrap();
        let at = text.find(from).unwrap();
        let mut bytes = good.clone();
        bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
        refusal(Format::Npy, &bytes)
    };
    let wanted = "expected an array of shape (n, 6) or (n, 8), dtype <f4 or <f8, in C order";
    for (from, to) in [("<f8", "<i8"), ("<f8", ">f8"), ("(1, 8)", "(1, 7)"), ("False", "True "), ("(1, 8)", "(8,)  ")] {
        assert!(changed(from, to).ends_with(wanted), "{from} {to}: {}", changed(from, to));
    }
    assert_eq!(changed("(1, 8)", "(9, 8)"), "rays: row 1: the file ends, expected 9 rows");
    assert!(changed("(1, 8)", "(0, 8)").ends_with("expected the end of the file after the last row"));
    let mut nan = good.clone();
    let last = nan.len() - 8;
    nan[last..].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_eq!(
        refusal(Format::Npy, &nan),
        "rays: row 0: column tmax: found NaN, expected a number or inf in single precision"
    );
    assert!(refusal(Format::Npy, b"1,2,3").contains("expected an array as numpy.save writes it"));

    for (version, shown) in [([0, 0], "0.0"), ([4, 0], "4.0"), ([1, 1], "1.1")] {
        let mut bytes = good.clone();
        bytes[6..8].copy_from_slice(&version);
        let message = format!("rays: found version {shown}, expected version 1.0, 2.0 or 3.0 of NPY");
        assert_eq!(refusal(Format::Npy, &bytes), message);
    }
    assert_eq!(refusal(Format::Csv, b"\xFF\xFE0\0"), "rays: found a text in UTF-16, expected one in UTF-8");

    let object = |text: &str| refusal(Format::JsonLines, text.as_bytes());
    assert!(object("{\"origin\":[1,2,3]}").contains("line 1: column 18: missing field `direction`"));
    assert!(object("{\"origin\":[1,2,3],\"direction\":[0,0,1],\"tmx\":1}").contains("unknown field `tmx`"));
    assert!(object("{\"origin\":[1,2,3],\"direction\":[0,0,0]}").contains("line 1: direction is zero"));
    assert!(object("{\"origin\":[1,2,1e39],\"direction\":[0,0,1]}").contains("line 1: column"));
    assert!(object("\n").contains("no rays, expected at least one line like {"));
}

/// After rounding, the end of the interval would be infinite.
#[test]
fn an_interval_that_is_finite_and_beyond_the_precision_is_refused() {
    let double = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1e39_f64].map(f64::to_le_bytes).concat();
    let header = format!("{:<117}\n", "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 8), }");
    let array = [&b"\x93NUMPY\x01\0\x76\0"[..], header.as_bytes(), &double].concat();
    let object = r#"{"origin":[0,0,0],"direction":[0,0,1],"tmax":1e39}"#;
    for (format, bytes) in
        [(Format::Csv, &b"0,0,0,0,0,1,0,1e39"[..]), (Format::JsonLines, object.as_bytes()), (Format::Npy, &array)]
    {
        let error = read_rows_from::<Ray>(bytes, "rays", format).unwrap_err().to_string();
        assert!(
            error.contains("column tmax: found ") && error.ends_with("a number or inf in single precision"),
            "{error}"
        );
        let rays = read_rows_from::<Ray<DVec3>>(bytes, "rays", format).unwrap().rows;
        assert_eq!(rays[0].tmax(), 1e39);
    }
    let far = read_rows_from::<Ray<DVec3>>(&b"0,0,0,0,0,1,0,1e999"[..], "rays", Format::Csv).unwrap_err().to_string();
    assert!(far.ends_with("column tmax: found \"1e999\", expected a number or inf in double precision"), "{far}");
}

#[test]
fn the_extension_says_the_format() {
    for (name, format) in [("a.csv", Format::Csv), ("a.JSONL", Format::JsonLines), ("a.ndjson", Format::JsonLines)] {
        assert_eq!(Format::of(Path::new(name)), Ok(Some(format)));
    }
    assert_eq!(Format::of(Path::new("-")), Ok(None));
    let refused = Format::of(Path::new("a.parquet")).unwrap_err().to_string();
    assert_eq!(refused, "a.parquet: extension \"parquet\", expected csv, jsonl or npy");
}

#[test]
fn points_are_read_from_all_formats() {
    let point = Point(Vec3::new(1.0, -0.5, 1e-40));
    let bytes = [1.0, -0.5, 1e-40_f32].map(f32::to_le_bytes).concat();
    let files = [
        (Format::Csv, b"# one\nx,y,z\n1,-.5,1e-40\n".to_vec()),
        (Format::JsonLines, b"{\"point\":[1,-0.5,1e-40]}".to_vec()),
        (Format::Npy, array("<f4", 3, bytes)),
    ];
    for (format, bytes) in &files {
        assert_eq!(read_rows_from::<Point<Vec3>>(&bytes[..], "points", *format).unwrap().rows, [point], "{format}");
    }
    let refusal = |format, bytes: &[u8]| {
        let read = read_rows_from::<Point<DVec3>>(bytes, "points", format);
        read.map_or_else(|error| error.to_string(), |loaded| loaded.note("points".as_ref(), 1.0).unwrap())
    };
    let cases = [
        (Format::Csv, "x,y,z\n", "no points, expected at least one line of x,y,z"),
        (Format::Csv, "1,2\n", "line 1: 2 columns, expected 3: x,y,z"),
        (Format::Csv, "1,2,3\n1,2,3,4\n", "line 2: 4 columns, expected 3: x,y,z"),
        (Format::Csv, "1,2,inf\n", "line 1: column z: found \"inf\", expected a finite number in double precision"),
        (Format::JsonLines, "", "no points, expected at least one line like {\"point\":[0,0,0]}"),
        (
            Format::Csv,
            "0.1,0,0\n",
            "1 of 3 numbers was rounded to double precision, by at most 7.0e-18 of the scene's size",
        ),
    ];
    for (format, text, message) in cases {
        assert_eq!(refusal(format, text.as_bytes()), format!("points: {message}"));
    }
    assert!(refusal(Format::JsonLines, b"{\"origin\":[1,2,3]}").contains("unknown field `origin`"));
    let (_, rays) = in_all_formats().swap_remove(5);
    assert!(refusal(Format::Npy, &rays).ends_with("an array of shape (n, 3), dtype <f4 or <f8, in C order"));
}
