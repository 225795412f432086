//! Positions for the labels of points: labels overlap neither each other nor a point, and stay in the frame.

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) fn around((x, y): (f64, f64), width: f64, height: f64) -> Self {
        Self { x: x - width / 2.0, y: y - height / 2.0, width, height }
    }

    pub(super) fn right(&self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.y + self.height
    }

    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.x < other.right() && other.x < self.right() && self.y < other.bottom() && other.y < self.bottom()
    }

    pub(super) fn contains(&self, other: &Self) -> bool {
        self.x <= other.x && self.y <= other.y && other.right() <= self.right() && other.bottom() <= self.bottom()
    }

    /// The nearest point of the rectangle.
    pub(super) fn nearest(&self, (x, y): Point) -> Point {
        (x.clamp(self.x, self.right()), y.clamp(self.y, self.bottom()))
    }

    /// Whether a line between two points meets the rectangle (slab test).
    fn meets(&self, (a, b): (Point, Point)) -> bool {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (a, b, low, high) in [(a.0, b.0, self.x, self.right()), (a.1, b.1, self.y, self.bottom())] {
            let d = b - a;
            if d == 0.0 {
                if a <= low || a >= high {
                    return false;
                }
                continue;
            }
            let (near, far) = ((low - a) / d, (high - a) / d);
            (from, to) = (from.max(near.min(far)), to.min(near.max(far)));
        }
        from < to
    }
}

type Point = (f64, f64);

/// A placed label, and the line to its point if the point is not adjacent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) label: Rect,
    pub(super) leader: Option<(Point, Point)>,
}

/// Radius of markers.
pub(super) const MARK: f64 = 8.0;
/// Labels further from their point have a leader.
const NEAR: f64 = 7.0;

/// Returns the free position nearest to its point for each label, avoiding `lines` if possible; `None` if there is no
/// free position. Labels and points correspond by index.
///
/// Labels close to a cluster of points block other labels. So labels of clusters are moved away until all labels have a
/// position.
pub(super) fn place(frame: &Rect, points: &[Point], sizes: &[Point], lines: &[(Point, Point)]) -> Vec<Option<Placed>> {
    let count = |placed: &Vec<Option<Placed>>| placed.iter().flatten().count();
    let mut best = Vec::new();
    for away in [0.0, 25.0, 50.0, 80.0, 120.0, 180.0, 260.0] {
        let placed = place_away(frame, points, sizes, lines, away);
        if best.is_empty() || count(&placed) > count(&best) {
            best = placed;
        }
        if count(&best) == points.len() {
            break;
        }
    }
    best
}

/// Like [`place`], with labels of clusters at this distance.
fn place_away(
    frame: &Rect,
    points: &[Point],
    sizes: &[Point],
    lines: &[(Point, Point)],
    away: f64,
) -> Vec<Option<Placed>> {
    let marks: Vec<Rect> = points.iter().map(|&point| Rect::around(point, 2.0 * MARK, 2.0 * MARK)).collect();
    let (mut labels, mut leaders) = (Vec::<Rect>::new(), Vec::<(Point, Point)>::new());
    let mut placed = vec![None; points.len()];
    let crowd =
        |i: usize| points.iter().filter(|other| (other.0 - points[i].0).hypot(other.1 - points[i].1) < 50.0).count();
    // Labels with most free space come first. Later labels have leaders around them.
    let mut order: Vec<usize> = (0..points.len().min(sizes.len())).collect();
    order.sort_by_key(|&i| (crowd(i), i));
    for i in order {
        let is_free = |candidate: &Placed, lines: &[(Point, Point)], marks_crossed: bool| {
            let Placed { label, leader } = candidate;
            let crosses = |other: &Rect| leader.is_some_and(|line| other.meets(line));
            frame.contains(label)
                && !marks.iter().chain(&labels).any(|other| other.overlaps(label))
                && !leaders.iter().chain(lines).any(|&line| label.meets(line))
                && !labels.iter().any(crosses)
                && (marks_crossed || !marks.iter().enumerate().any(|(j, mark)| j != i && crosses(mark)))
        };
        let from = if crowd(i) > 3 { away } else { 0.0 };
        // Tolerate crossings with lines of the chart first, then with markers of other points.
        let tries = [(lines, false), (&[], false), (&[], true)];
        let find = |&(lines, crossed): &(&[_], bool)| {
            candidates(frame, points[i], sizes[i], from).find(|candidate| is_free(candidate, lines, crossed))
        };
        placed[i] = tries.iter().find_map(find);
        if let Some(Placed { label, leader }) = placed[i] {
            // Leave space around the label.
            labels.push(Rect { x: label.x - 2.0, width: label.width + 4.0, ..label });
            leaders.extend(leader);
        }
    }
    placed
}

/// Positions in rings around a point, the nearest first.
fn candidates(frame: &Rect, point: Point, (width, height): Point, from: f64) -> impl Iterator<Item = Placed> {
    const TURNS: u32 = 48;
    let rings = ((frame.width.hypot(frame.height)) / 6.0) as u32;
    (0..rings.max(1)).flat_map(move |ring| {
        let away = MARK + 2.0 + from + 6.0 * f64::from(ring);
        (0..TURNS).map(move |turn| {
            let (sin, cos) = (f64::from(turn) * std::f64::consts::TAU / f64::from(TURNS)).sin_cos();
            // The distance of the box's nearer side.
            let centre = (point.0 + cos * (away + width / 2.0), point.1 + sin * (away + height / 2.0));
            let label = Rect::around(centre, width, height);
            let end = label.nearest(point);
            let distance = (end.0 - point.0).hypot(end.1 - point.1);
            let rim = |t: f64| (point.0 + (end.0 - point.0) * t / distance, point.1 + (end.1 - point.1) * t / distance);
            Placed { label, leader: (distance > MARK + NEAR).then(|| (rim(MARK), end)) }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plots::tests::unit;
    use stackless_bvh::generate::Rng;

    #[test]
    fn labels_keep_apart_at_any_size() {
        let mut random = Rng::new(3);
        let mut unit = || unit(&mut random);
        let (mut wanted, mut found, mut led) = (0, 0, 0);
        for round in 0..150 {
            let (width, height) = [(220.0, 160.0), (400.0, 300.0), (800.0, 480.0), (1600.0, 900.0)][round % 4];
            let frame = Rect { x: 40.0, y: 30.0, width, height };
            let count = 1 + (unit() * 24.0) as usize;
            // Half of the charts have a cluster.
            let spread = if round % 8 < 4 { 1.0 } else { 0.06 };
            let points: Vec<Point> = (0..count)
                .map(|_| {
                    (40.0 + width * (0.5 + spread * (unit() - 0.5)), 30.0 + height * (0.5 + spread * (unit() - 0.5)))
                })
                .collect();
            let sizes: Vec<Point> = (0..count).map(|_| (20.0 + 100.0 * unit(), 15.0)).collect();
            let placed = place(&frame, &points, &sizes, &[]);
            let all: Vec<&Placed> = placed.iter().flatten().collect();
            for (i, a) in all.iter().enumerate() {
                assert!(frame.contains(&a.label), "{a:?}");
                assert!(points.iter().all(|&point| !a.label.overlaps(&Rect::around(point, 2.0 * MARK, 2.0 * MARK))));
                assert!(all[..i].iter().all(|b| !a.label.overlaps(&b.label)), "{a:?}");
                assert!(all.iter().all(|b| !b.leader.is_some_and(|line| a.label.meets(line))), "{a:?}");
            }
            if width >= 800.0 {
                (wanted, found) = (wanted + count, found + all.len());
            }
            led += all.iter().filter(|it| it.leader.is_some()).count();
        }
        assert!(found == wanted && led > 0, "{found} of {wanted} labels, {led} leaders");
    }

    #[test]
    fn a_line_meets_what_it_crosses() {
        let label = Rect { x: 0.0, y: 0.0, width: 10.0, height: 4.0 };
        for (line, expected) in [
            (((-5.0, 2.0), (15.0, 2.0)), true),
            (((-5.0, 5.0), (15.0, 5.0)), false),
            (((5.0, -5.0), (5.0, -1.0)), false),
            (((-5.0, 2.0), (0.0, 2.0)), false),
            (((2.0, 2.0), (3.0, 3.0)), true),
        ] {
            assert_eq!(label.meets(line), expected, "{line:?}");
        }
    }
}
