"""Triangle meshes as plain data: lists of points, unit normals and index triples, counter-clockwise seen from outside."""
import math


class Mesh:
    def __init__(self, points=None, normals=None, triangles=None):
        self.points, self.normals, self.triangles = points or [], normals or [], triangles or []

    def add(self, other):
        base = len(self.points)
        self.points += other.points
        self.normals += other.normals
        self.triangles += [tuple(base + i for i in t) for t in other.triangles]
        return self


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def mul(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return mul(a, 1 / math.sqrt(dot(a, a)))


def quad(a, b, c, d):
    """A flat quad; four corners, counter-clockwise seen from the side of the normal."""
    n = unit(cross(sub(b, a), sub(d, a)))
    return Mesh([a, b, c, d], [n] * 4, [(0, 1, 2), (0, 2, 3)])


def prism(base, height):
    """Prism over a polygon of (x, z) at y = 0, counter-clockwise seen from above; four corners, without its bottom."""
    up = [(x, height, z) for x, z in base]
    down = [(x, 0.0, z) for x, z in base]
    mesh = quad(*up)
    for i in range(len(base)):
        j = (i + 1) % len(base)
        mesh.add(quad(down[i], down[j], up[j], up[i]))
    return mesh


def box(low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    mesh = quad((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1))
    mesh.add(quad((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)))
    mesh.add(quad((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)))
    mesh.add(quad((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)))
    mesh.add(quad((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)))
    return mesh.add(quad((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)))


def grid(rows, columns, point_and_normal, wrap_columns=False):
    """Smooth surface: point_and_normal(row, column) for row <= rows, column <= columns. Columns run to the right and rows
    upwards seen from outside. Degenerate triangles, at poles, are skipped."""
    mesh = Mesh()
    width = columns if wrap_columns else columns + 1
    for row in range(rows + 1):
        for column in range(width):
            p, n = point_and_normal(row, column)
            mesh.points.append(p)
            mesh.normals.append(n)
    for row in range(rows):
        for column in range(columns):
            a, b = row * width + column, row * width + (column + 1) % width
            c, d = b + width, a + width
            for t in ((a, b, c), (a, c, d)):
                p, q, r = (mesh.points[i] for i in t)
                if dot(*[cross(sub(q, p), sub(r, p))] * 2) > 1e-24:
                    mesh.triangles.append(t)
    return mesh


def sphere(center, radius, rows, columns):
    def at(row, column):
        theta, phi = math.pi * row / rows, 2 * math.pi * column / columns
        ring = 0.0 if row in (0, rows) else math.sin(theta)
        n = (ring * math.sin(phi), -math.cos(theta), ring * math.cos(phi))
        return add(center, mul(n, radius)), n

    return grid(rows, columns, at, wrap_columns=True)


def faceted(mesh):
    """The same triangles with flat normals."""
    flat = Mesh()
    for t in mesh.triangles:
        a, b, c = (mesh.points[i] for i in t)
        n = unit(cross(sub(b, a), sub(c, a)))
        flat.add(Mesh([a, b, c], [n] * 3, [(0, 1, 2)]))
    return flat


def rounded(corners, arc_steps):
    """(point, unit normal) along a polyline of (r, y, fillet radius) with rounded inner corners. The normal is to
    the right of the direction of travel."""
    out = []

    def emit(p, tangent):
        out.append((p, (tangent[1], -tangent[0])))

    points = [c[:2] for c in corners]
    emit(points[0], unit(sub(points[1], points[0])))
    for i in range(1, len(corners) - 1):
        into, away = unit(sub(points[i], points[i - 1])), unit(sub(points[i + 1], points[i]))
        turn = math.atan2(into[0] * away[1] - into[1] * away[0], dot(into, away))
        cut = corners[i][2] * math.tan(abs(turn) / 2)
        start = sub(points[i], mul(into, cut))
        side = math.copysign(1, turn)
        center = add(start, mul((-into[1], into[0]), side * corners[i][2]))
        for k in range(arc_steps + 1):
            angle = turn * k / arc_steps
            c, s = math.cos(angle), math.sin(angle)
            spoke = sub(start, center)
            emit(add(center, (c * spoke[0] - s * spoke[1], s * spoke[0] + c * spoke[1])),
                 (c * into[0] - s * into[1], s * into[0] + c * into[1]))
    emit(points[-1], unit(sub(points[-1], points[-2])))
    return out


def curved(points, steps):
    """(point, unit normal) along a smooth curve through points (r, y), a centripetal Catmull-Rom spline (Barry and Goldman 1988) with
    `steps` pieces between two of them; it begins and ends at right angles to the axis. The normal is to the right of the direction of
    travel."""
    ends = [(-points[1][0], points[1][1]), *points, (-points[-2][0], points[-2][1])]
    knots = [0.0]
    for a, b in zip(ends, ends[1:]):
        knots.append(knots[-1] + math.dist(a, b) ** 0.5)

    def at(i, t):
        p, k = list(ends[i - 1:i + 3]), knots[i - 1:i + 3]
        for intervals in (((0, 1), (1, 2), (2, 3)), ((0, 2), (1, 3)), ((1, 2),)):
            for j, (low, high) in enumerate(intervals):
                f = (t - k[low]) / (k[high] - k[low])
                p[j] = tuple((1 - f) * x + f * y for x, y in zip(p[j], p[j + 1]))
        return p[0]

    out = []
    for i in range(1, len(points)):
        for step in range(steps + (i == len(points) - 1)):
            span = knots[i + 1] - knots[i]
            t = knots[i] + span * step / steps
            ahead, behind = at(i, t + 1e-4 * span), at(i, t - 1e-4 * span)
            tangent = unit(sub(ahead, behind))
            point = at(i, t)
            if i == 1 and step == 0 or i == len(points) - 1 and step == steps:
                tangent = (1.0 if i == 1 else -1.0, 0.0)
                point = points[0] if i == 1 else points[-1]
            out.append((point, (tangent[1], -tangent[0])))
    return out


def lathe(profile, columns):
    """Surface of revolution about y of a profile of ((r, y), (normal r, normal y)), from the bottom outside to the inside."""
    def at(row, column):
        (r, y), (nr, ny) = profile[row]
        phi = 2 * math.pi * column / columns
        return (r * math.sin(phi), y, r * math.cos(phi)), (nr * math.sin(phi), ny, nr * math.cos(phi))

    return grid(len(profile) - 1, columns, at, wrap_columns=True)


def tube(path, half_width, half_height, rows, columns):
    """Elliptical tube along path(t), t in [0, 1], in the plane z = 0, with flat caps. path gives point and unit tangent in 2D;
    half_width is along z, half_height across the path in its plane."""
    def frame(t):
        (x, y), (tx, ty) = path(t)
        return (x, y, 0.0), (tx, ty, 0.0), (-ty, tx, 0.0)

    def at(row, column):
        center, _, side = frame(row / rows)
        phi = 2 * math.pi * column / columns
        c, s = math.cos(phi), math.sin(phi)
        p = add(center, add(mul(side, half_height * c), (0, 0, half_width * s)))
        n = unit(add(mul(side, c / half_height), (0, 0, s / half_width)))
        return p, n

    mesh = grid(rows, columns, at, wrap_columns=True)
    for row, outward in ((0, -1), (rows, 1)):
        center, tangent, _ = frame(row / rows)
        ring = [at(row, column)[0] for column in range(columns)]
        normal = mul(tangent, outward)
        order = [(0, i + 1, (i + 1) % columns + 1) for i in range(columns)]
        if outward < 0:
            order = [(a, c, b) for a, b, c in order]
        mesh.add(Mesh([center] + ring, [normal] * (columns + 1), order))
    return mesh
