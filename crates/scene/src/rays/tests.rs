use super::*;
use crate::tests::{Folder, Random};

fn read(text: &str) -> Result<Vec<Ray>, RayFileError> {
    read_rays_from(text.as_bytes(), "rays.csv")
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
    // However lines end, and whatever the size of what is read at once.
    let plain = text.replace("\r\n", "\n");
    for end in ["\n", "\r", "\r\n", "\r\r\n"] {
        for mark in ["", "\u{feff}"] {
            let text = format!("{mark}{}", plain.replace('\n', end));
            for capacity in [1, 2, 7, 4096] {
                let reader = BufReader::with_capacity(capacity, text.as_bytes());
                assert_eq!(read_rays_from(reader, "rays.csv").unwrap(), rays, "{text:?}");
            }
        }
    }
    assert_eq!(refusal("#\r\n#\r#\n1\r"), read("\n\n\n1").unwrap_err().to_string());
}

#[test]
fn a_line_without_end_is_refused_before_memory_is_gone() {
    let endless = BufReader::new(io::repeat(b'0'));
    let message = read_rays_from(endless, "rays.csv").unwrap_err().to_string();
    assert_eq!(message, "rays.csv: line 1: more than 4096 bytes, expected ox,oy,oz,dx,dy,dz,tmin,tmax");
    let long = |length: usize| format!("{}0,0,0,0,0,1,0,1\n", " ".repeat(length - 15));
    assert_eq!(read(&long(4096)).unwrap().len(), 1);
    assert!(matches!(read(&long(4097)), Err(RayFileError::Line { line: 1, fault: RayFault::Length, .. })));
}

#[test]
fn each_error_names_line_and_column() {
    let names = "ox,oy,oz,dx,dy,dz,tmin,tmax";
    let cases = [
        ("", format!("no rays, expected at least one line of {names}")),
        ("# none\n\n", format!("no rays, expected at least one line of {names}")),
        (names, format!("no rays, expected at least one line of {names}")),
        ("\n0,0,0,0,0,1,0\n", format!("line 2: 7 columns, expected 8: {names}")),
        ("0,0,0,0,0,1,0,1,\n", format!("line 1: 9 columns, expected 8: {names}")),
        ("oy,ox,oz,dx,dy,dz,tmin,tmax\n", "line 1: column ox: found \"oy\", expected a finite number".into()),
        ("0,0,0,0,0,1,0,\n", "line 1: column tmax: found \"\", expected a number or inf".into()),
        ("0,0,0,0,0,1,0,nan\n", "line 1: column tmax: found \"nan\", expected a number or inf".into()),
        ("0,0,0,0,0,1,0,-inf\n", "line 1: column tmax: found \"-inf\", expected a number or inf".into()),
        ("0,0,0,0,0,1,inf,inf\n", "line 1: column tmin: found \"inf\", expected a finite number".into()),
        ("0,0,nan,0,0,1,0,1\n", "line 1: column oz: found \"nan\", expected a finite number".into()),
        ("0,0,0,1e39,0,1,0,1\n", "line 1: column dx: found \"1e39\", expected a finite number".into()),
        ("0,0,0,0,0,1;0,0,1\n", "line 1: column dz: found \"1;0\", expected a finite number".into()),
        ("0,0,0,0,0,-0,0,1\n", "line 1: direction is zero".into()),
        ("0,0,0,0,0,1,-1,1\n", "line 1: tmin -1 is negative".into()),
        ("0,0,0,0,0,1,0,1\n0,0,0,0,0,1,2,1\n", "line 2: tmin 2 is greater than tmax 1".into()),
    ];
    for (text, message) in cases {
        assert_eq!(refusal(text), format!("rays.csv: {message}"), "{text}");
    }
    let twice = format!("{names}\n{names}\n");
    assert_eq!(refusal(&twice), "rays.csv: line 2: column ox: found \"ox\", expected a finite number");
    assert!(read_rays_from(&b"0,0,0,0,0,1,0,\xFF\n"[..], "rays.csv").is_err());
}

#[test]
fn a_missing_file_is_named() {
    let folder = Folder::new("rays");
    let path = folder.file("missing.csv");
    let message = read_rays(&path).unwrap_err().to_string();
    assert!(message.starts_with(&format!("{}: cannot be read: ", path.display())), "{message}");
    std::fs::write(&path, "0,0,0,0,0,1,0,1\n").unwrap();
    assert_eq!(read_rays(&path).unwrap().len(), 1);
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

#[test]
fn hits_read_back_bit_for_bit() {
    let mut random = Random(11);
    let mut hits = vec![None, Some((u32::MAX, 0.0, -0.0, f32::MIN_POSITIVE / 8.0)), Some((0, f32::MAX, 1.0, 1e-7))];
    for _ in 0..5_000 {
        let [t, u, v] = std::array::from_fn(|_| f32::from_bits(random.next() as u32 & 0xBF7F_FFFF));
        hits.push((random.below(4) != 0).then_some((random.next() as u32, t, u, v)));
    }
    let mut text = Vec::new();
    write_hits(&mut text, hits.iter().copied()).unwrap();
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
    let mut full = [0; 20];
    assert!(write_hits(&mut full[..], std::iter::repeat_n(None, 10)).is_err());
}
