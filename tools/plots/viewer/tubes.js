"use strict";

// All fibers as one mesh of tubes of their true radius, with flat ends.

class Tubes {
  constructor() {
    this.sides = nPoints > 20000 ? 6 : nPoints > 4000 ? 8 : 14;
    this.rows = nPoints + 4 * nFibers;  // two more at each end: the rim once more, and the middle
    const nVertices = this.rows * this.sides;
    this.position = new Float32Array(3 * nVertices);
    this.normal = new Float32Array(3 * nVertices);
    this.colour = new Uint8Array(3 * nVertices);
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(this.position, 3));
    this.geometry.setAttribute("normal", new THREE.BufferAttribute(this.normal, 3));
    this.geometry.setAttribute("color", new THREE.BufferAttribute(this.colour, 3, true));
    this.geometry.setIndex(new THREE.BufferAttribute(this.makeTriangles(), 1));
    const material = new THREE.MeshStandardMaterial({
      vertexColors: THREE.VertexColors, roughness: 0.45, metalness: 0.05, side: THREE.DoubleSide });
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.circle = Array.from({ length: this.sides }, (_, k) => {
      const angle = (2 * Math.PI * k) / this.sides;
      return [Math.cos(angle), Math.sin(angle)];
    });
  }

  makeTriangles() {
    const triangles = [], n = this.sides;
    let row = 0;
    for (let fiber = 0; fiber < nFibers; ++fiber) {
      for (let last = row + view.points[fiber] + 3; row < last; ++row)
        for (let k = 0; k < n; ++k) {
          const a = row * n + k, b = row * n + ((k + 1) % n);
          triangles.push(a, b, a + n, b, b + n, a + n);
        }
      ++row;
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

  updateFiber(fiber, row, places, colourAt) {
    const first = firstPoint[fiber], n = view.points[fiber], radius = view.radius[fiber];
    const at = (i) => [places[3 * (first + i)], places[3 * (first + i) + 1], places[3 * (first + i) + 2]];
    let across = null, along = null;
    for (let i = 0; i < n; ++i) {
      along = this.direction(at(Math.max(i - 1, 0)), at(Math.min(i + 1, n - 1)), along);
      across = this.turnAlong(across, along);
      const third = [along[1] * across[2] - along[2] * across[1], along[2] * across[0] - along[0] * across[2],
        along[0] * across[1] - along[1] * across[0]];
      const centre = at(i), colour = colourAt(fiber, first + i), back = along.map((c) => -c);
      if (i === 0) {
        this.setRow(row++, centre, across, third, 0, colour, back);
        this.setRow(row++, centre, across, third, radius, colour, back);
      }
      this.setRow(row++, centre, across, third, radius, colour, null);
      if (i === n - 1) {
        this.setRow(row++, centre, across, third, radius, colour, along);
        this.setRow(row++, centre, across, third, 0, colour, along);
      }
    }
    return row;
  }

  direction(from, to, before) {
    const d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    const size = Math.hypot(d[0], d[1], d[2]);
    return size > 0 ? d.map((c) => c / size) : before || [1, 0, 0];
  }

  /// The direction across at the point before, turned with the centreline without twist.
  turnAlong(before, along) {
    const start = before || (Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]);
    const part = start[0] * along[0] + start[1] * along[1] + start[2] * along[2];
    const across = start.map((c, i) => c - part * along[i]);
    const size = Math.hypot(across[0], across[1], across[2]);
    return size > 1e-6 ? across.map((c) => c / size) : this.turnAlong(Math.abs(along[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], along);
  }

  setRow(row, centre, across, third, radius, colour, normal) {
    for (let k = 0; k < this.sides; ++k) {
      const [a, b] = this.circle[k], at = 3 * (row * this.sides + k);
      for (let c = 0; c < 3; ++c) {
        const out = a * across[c] + b * third[c];
        this.position[at + c] = centre[c] + radius * out;
        this.normal[at + c] = normal ? normal[c] : out;
        this.colour[at + c] = colour[c];
      }
    }
  }
}
