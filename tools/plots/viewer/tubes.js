"use strict";

// All fibers as one mesh of tubes of their true radius, with flat ends.

class Tubes {
  constructor() {
    this.sides = nPoints > 8000 ? 6 : nPoints > 800 ? 8 : 14;
    this.rows = nPoints + 4 * nFibers;  // two more at each end: the rim once more, and the middle
    const nVertices = this.rows * this.sides;
    this.position = new Float32Array(3 * nVertices);
    this.normal = new Int8Array(3 * nVertices);
    this.colour = new Uint8Array(3 * nVertices);
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(this.position, 3));
    this.geometry.setAttribute("normal", new THREE.BufferAttribute(this.normal, 3, true));
    this.geometry.setAttribute("color", new THREE.BufferAttribute(this.colour, 3, true));
    this.geometry.setIndex(new THREE.BufferAttribute(this.makeTriangles(), 1));
    // Lit at vertices: of tubes whose sides have normals of their own that looks the same, and costs software a fraction.
    const material = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors });
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    const angles = Array.from({ length: this.sides }, (_, k) => (2 * Math.PI * k) / this.sides);
    this.cosines = Float32Array.from(angles, Math.cos);
    this.sines = Float32Array.from(angles, Math.sin);
  }

  /// Front sides outwards.
  makeTriangles() {
    const triangles = [], n = this.sides;
    for (let fiber = 0, row = 0; fiber < nFibers; ++fiber, row += 4) {  // middle, rim, the sides' rows, rim, middle
      const end = row + view.points[fiber] + 2;
      for (let k = 0; k < n; ++k) {
        const next = (k + 1) % n;
        triangles.push(row * n, (row + 1) * n + next, (row + 1) * n + k);
        for (let i = row + 2; i + 1 < end; ++i)
          triangles.push(i * n + k, i * n + next, (i + 1) * n + k, i * n + next, (i + 1) * n + next, (i + 1) * n + k);
        triangles.push((end + 1) * n, end * n + k, end * n + next);
      }
      row += view.points[fiber];
    }
    return new Uint32Array(triangles);
  }

  /// @param places    [points][3]
  /// @param colourAt  (fiber, point) -> [red, green, blue], 0 .. 255
  update(places, colourAt) {
    let row = 0;
    for (let fiber = 0; fiber < nFibers; ++fiber) row = this.updateFiber(fiber, row, places, colourAt);
    for (const name of ["position", "normal", "color"]) this.geometry.attributes[name].needsUpdate = true;
  }

  /// Numbers only, and no small arrays: this runs for every point of every picture.
  updateFiber(fiber, row, places, colourAt) {
    const first = firstPoint[fiber], n = view.points[fiber], radius = view.radius[fiber];
    let ax = 1, ay = 0, az = 0;                       // along the centreline
    let bx = 0, by = 0, bz = 0, isTurned = false;     // across it, turned along without twist
    for (let i = 0; i < n; ++i) {
      const here = 3 * (first + i), from = i > 0 ? here - 3 : here, to = i < n - 1 ? here + 3 : here;
      const dx = places[to] - places[from], dy = places[to + 1] - places[from + 1], dz = places[to + 2] - places[from + 2];
      const apart = Math.sqrt(dx * dx + dy * dy + dz * dz);
      if (apart > 0) [ax, ay, az] = [dx / apart, dy / apart, dz / apart];
      if (!isTurned) [bx, by, bz] = Math.abs(az) < 0.9 ? [0, 0, 1] : [1, 0, 0];
      for (let isAcross = false; !isAcross;) {
        const part = ax * bx + ay * by + az * bz;
        const x = bx - part * ax, y = by - part * ay, z = bz - part * az, size = Math.sqrt(x * x + y * y + z * z);
        isAcross = size > 1e-6;
        if (isAcross) [bx, by, bz] = [x / size, y / size, z / size];
        else [bx, by, bz] = Math.abs(ax) < 0.9 ? [1, 0, 0] : [0, 1, 0];  // a centreline that folds back on itself
      }
      isTurned = true;
      const colour = colourAt(fiber, first + i), red = colour[0], green = colour[1], blue = colour[2];
      const cx = ay * bz - az * by, cy = az * bx - ax * bz, cz = ax * by - ay * bx;
      const x = places[here], y = places[here + 1], z = places[here + 2];
      if (i === 0) {
        this.setRow(row++, x, y, z, 0, bx, by, bz, cx, cy, cz, red, green, blue, -ax, -ay, -az);
        this.setRow(row++, x, y, z, radius, bx, by, bz, cx, cy, cz, red, green, blue, -ax, -ay, -az);
      }
      this.setRow(row++, x, y, z, radius, bx, by, bz, cx, cy, cz, red, green, blue, 0, 0, 0);
      if (i === n - 1) {
        this.setRow(row++, x, y, z, radius, bx, by, bz, cx, cy, cz, red, green, blue, ax, ay, az);
        this.setRow(row++, x, y, z, 0, bx, by, bz, cx, cy, cz, red, green, blue, ax, ay, az);
      }
    }
    return row;
  }

  /// A circle about a place, in the plane of b and c; normals are n, or outwards where that is zero.
  setRow(row, x, y, z, radius, bx, by, bz, cx, cy, cz, red, green, blue, nx, ny, nz) {
    const { position, normal, colour, cosines, sines, sides } = this, isFlat = nx !== 0 || ny !== 0 || nz !== 0;
    for (let k = 0, at = 3 * row * sides; k < sides; ++k, at += 3) {
      const cosine = cosines[k], sine = sines[k];
      const ox = cosine * bx + sine * cx, oy = cosine * by + sine * cy, oz = cosine * bz + sine * cz;
      position[at] = x + radius * ox;
      position[at + 1] = y + radius * oy;
      position[at + 2] = z + radius * oz;
      normal[at] = 127 * (isFlat ? nx : ox);
      normal[at + 1] = 127 * (isFlat ? ny : oy);
      normal[at + 2] = 127 * (isFlat ? nz : oz);
      colour[at] = red;
      colour[at + 1] = green;
      colour[at + 2] = blue;
    }
  }
}
