"""Draws memory over time: python soak_picture.py LABEL=CSV... > soak.svg"""

import csv
import sys

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 760, 360, 60, 20, 150, 50
COLOURS = ["#1f77b4", "#d62728", "#2ca02c"]


def steps(top):
    """Returns about five round numbers, from 0 up."""
    step = next(n for e in range(9) for n in (10**e, 2 * 10**e, 5 * 10**e) if top <= 6 * n)
    return range(0, int(top) + step + 1, step)


def main(arguments):
    curves = []
    for (label, path), colour in zip((argument.split("=", 1) for argument in arguments), COLOURS):
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        for column, dash in (("resident_kib", ""), ("used_kib", "4 3")):
            if column not in rows[0]:
                continue
            points = [(float(row["seconds"]) / 60, int(row[column]) / 1024) for row in rows]
            # The maximum of every ten seconds.
            points = [(points[i][0], max(mib for _, mib in points[i : i + 10])) for i in range(0, len(points), 10)]
            curves.append((f"{label}, {column.removesuffix('_kib')}", points, colour, dash))
    across = steps(max(time for _, points, *_ in curves for time, _ in points) - 1e-6)
    up = steps(max(mib for _, points, *_ in curves for _, mib in points))

    def x(time):
        return round(LEFT + (WIDTH - LEFT - RIGHT) * time / across[-1], 1)

    def y(mib):
        return round(HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * mib / up[-1], 1)

    box = f"0 0 {WIDTH} {HEIGHT}"
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" font-family="sans-serif" font-size="13">')
    print(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>')
    for mib in up:
        print(f'<path d="M{x(0)} {y(mib)}H{x(across[-1])}" stroke="#ddd"/>')
        print(f'<text x="{LEFT - 8}" y="{y(mib) + 4}" text-anchor="end">{mib}</text>')
    for time in across:
        print(f'<text x="{x(time)}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">{time}</text>')
    print(f'<text x="{x(across[-1] / 2)}" y="{HEIGHT - 8}" text-anchor="middle">minutes</text>')
    middle = y(up[-1] / 2)
    print(f'<text x="16" y="{middle}" text-anchor="middle" transform="rotate(-90 16 {middle})">MiB</text>')
    for label, points, colour, dash in curves:
        line = "L".join(f"{x(time)} {y(mib)}" for time, mib in points)
        print(f'<path d="M{line}" fill="none" stroke="{colour}" stroke-width="1.5" stroke-dasharray="{dash}"/>')
        print(f'<text x="{x(points[-1][0]) + 8}" y="{y(points[-1][1]) + 4}" fill="{colour}">{label}</text>')
    print("</svg>")


if __name__ == "__main__":
    main(sys.argv[1:])
