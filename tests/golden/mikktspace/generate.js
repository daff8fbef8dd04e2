// Makes the meshes of this folder and asks the MikkTSpace of the npm package `mikktspace` 1.1.1 for their tangents: the reference code, by way
// of Rust, as WebAssembly. It is under the MIT licence.
//
//   npm pack mikktspace@1.1.1 && tar -xzf mikktspace-1.1.1.tgz && node generate.js package
//
// Each mesh is a file NAME.json: per vertex `positions`, `normals` and `uvs`, per corner `indices` and `tangents`, with w as the reference has
// it, which is not glTF's: there v points down. Numbers are rounded before they are used, so that every reader has the same floats.
'use strict';
const fs = require('fs');
const path = require('path');
const { generateTangents } = require(path.resolve(process.argv[2], 'dist/main/mikktspace_main.js'));

let state = 1;
const random = () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
const round = (x, digits) => Number(x.toFixed(digits)) + 0;
const unit = v => v.map(x => x / Math.hypot(...v));

class Mesh {
    constructor() {
        this.vertices = [];
        this.indices = [];
    }
    vertex(position, normal, uv) {
        this.vertices.push([position.map(x => round(x, 4)), unit(normal).map(x => round(x, 7)), uv.map(x => round(x, 4))]);
        return this.vertices.length - 1;
    }
    // `at(x, y)` makes the vertex of x and y in [0, 1]; `other(i, j)`: that quad has the other diagonal.
    grid(columns, rows, at, other = () => false) {
        const first = this.vertices.length;
        for (let j = 0; j <= rows; ++j) for (let i = 0; i <= columns; ++i) this.vertex(...at(i / columns, j / rows));
        for (let j = 0; j < rows; ++j) {
            for (let i = 0; i < columns; ++i) {
                const a = first + j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
                this.indices.push(...(other(i, j) ? [a, b, d, b, c, d] : [a, b, c, a, c, d]));
            }
        }
        return this;
    }
    write(name) {
        const corners = part => new Float32Array(this.indices.flatMap(i => this.vertices[i][part]));
        const tangents = generateTangents(corners(0), corners(1), corners(2));
        const json = {
            positions: this.vertices.flatMap(v => v[0]), normals: this.vertices.flatMap(v => v[1]), uvs: this.vertices.flatMap(v => v[2]),
            indices: this.indices, tangents: Array.from(tangents, x => round(x, 7)),
        };
        const lines = Object.entries(json).map(([key, values]) => `"${key}": ${JSON.stringify(values)}`);
        fs.writeFileSync(path.join(__dirname, `${name}.json`), `{\n${lines.join(',\n')}\n}\n`);
    }
}

// A wavy sheet that lies along no axis.
const sheet = uv => (x, y) => {
    const z = 0.2 * Math.sin(5 * x + 3 * y);
    return [[x + 0.3 * y, y - 0.2 * x, z + 0.4 * x], unit([0.2 * Math.cos(4 * x) - 0.4, 0.3 * Math.cos(3 * y), 1]), uv(x, y)];
};

// With a seam, and at the poles a triangle without area in each quad.
new Mesh().grid(12, 6, (x, y) => {
    const phi = 2 * Math.PI * (x < 1 ? x : 0), theta = Math.PI * y;
    const direction = [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
    return [direction, direction, [x, y]];
}).write('sphere');

// Mirrored along the middle, whose vertices both halves share.
new Mesh().grid(6, 4, sheet((x, y) => [Math.abs(x - 0.5) + 0.1 * y, y])).write('mirrored');

// Quads of which every other one has the other diagonal, under a texture that is stretched unevenly.
new Mesh().grid(6, 6, sheet((x, y) => [x * x + 0.2 * y, y + 0.3 * Math.sin(4 * x)]), (i, j) => (i + j) % 2 === 1).write('diagonals');

// Triangles that have no area in the texture, in space, or in both, beside and between others.
{
    const mesh = new Mesh().grid(5, 5, sheet((x, y) => [x < 0.5 ? 0.25 : x, y < 0.7 ? y : 0.7]));
    const n = mesh.vertices.length;
    for (let i = 0; i < 12; ++i) {
        const at = Math.floor(random() * n), other = Math.floor(random() * n);
        mesh.indices.push(at, at, other, other, at, other);
    }
    const [p, normal] = mesh.vertices[8];
    mesh.vertex(p, normal, [0.9, 0.9]);
    mesh.vertex(p.map(x => x + 0.1), normal, [0.3, 0.9]);
    mesh.vertex(p.map(x => x + 0.2), normal, [0.2, 0.5]);
    mesh.indices.push(n, n + 1, n + 2, 8, n, 9, n, n + 1, 3, 14, n + 2, n + 2);
    mesh.write('degenerate');
}

// Jitter in everything, so that some triangles turn over in the texture or in space; and edges that more than two share.
{
    const jitter = (v, by) => v.map(x => x + by * (random() - 0.5));
    const mesh = new Mesh().grid(8, 8, (x, y) => {
        const [p, n, uv] = sheet((u, v) => [u, v])(x, y);
        return [jitter(p, 0.15), unit(jitter(n, 0.5)), jitter(uv, 0.25)];
    });
    for (let i = 0; i < 24; ++i) {
        const at = 3 * Math.floor(random() * mesh.indices.length / 3), apex = Math.floor(random() * mesh.vertices.length);
        const [a, b] = mesh.indices.slice(at, at + 2);
        mesh.indices.push(...(i % 3 === 0 ? [a, b, apex] : i % 3 === 1 ? [b, a, apex] : [a, b, mesh.indices[at + 2]]));
    }
    mesh.write('noisy');
}

// Sheets that turn back on themselves exactly: around a vertex there are directions that lie opposite to each other, which do not mix.
{
    const mesh = new Mesh();
    for (const [k, turn] of [0.3, 1.1, 2.9].entries()) {
        const c = Math.cos(turn), s = Math.sin(turn), normal = [0, 0, 1];
        const at = (x, y, uv) => mesh.vertex([3 * k + c * x - s * y, s * x + c * y, 0], normal, uv);
        const o = at(0, 0, [0, 0]), e = at(1, 0, [0, 1]), up = at(0, 1, [-1, 0]), down = at(0, 1, [1, 0]);
        const far = at(1, 2, [2, 1]), w = at(-1, 0.5, [-0.5, -1]);
        mesh.indices.push(o, e, up, e, o, down, down, far, e, o, up, w);
    }
    mesh.write('folded');
}
