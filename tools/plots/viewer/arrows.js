"use strict";

// The background flow as arrows on a grid of points; the longest is nearly as long as two points are apart where they are
// farthest from each other.

class Arrows {
  constructor(flow) {
    this.times = flow.times;
    this.points = unpack(flow.points, Float32Array);          // [arrows][3]
    this.velocities = unpack(flow.velocities, Float32Array);  // [times][arrows][3]
    this.n = this.points.length / 3;
    let fastest = 0;
    for (let i = 0; i < this.velocities.length; i += 3)
      fastest = Math.max(fastest, Math.hypot(this.velocities[i], this.velocities[i + 1], this.velocities[i + 2]));
    this.scale = fastest > 0 ? (0.85 * flow.widest) / fastest : 0;
    this.width = Math.min(0.045 * flow.widest, 0.12 * flow.narrowest);
    const material = new THREE.MeshLambertMaterial({ color: 0x8aa0b4, transparent: true, opacity: 0.55, depthWrite: false });
    this.mesh = new THREE.InstancedMesh(this.makeShape(), material, this.n);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1;
  }

  /// One arrow of length 1 along z, whose shaft and head are one geometry.
  makeShape() {
    const turn = new THREE.Matrix4().makeRotationX(Math.PI / 2);
    const shaft = new THREE.CylinderBufferGeometry(0.25, 0.25, 0.68, 6).translate(0, 0.34, 0).applyMatrix(turn);
    const head = new THREE.ConeBufferGeometry(0.8, 0.36, 10).translate(0, 0.82, 0).applyMatrix(turn);
    const shape = new THREE.BufferGeometry();
    for (const name of ["position", "normal"]) {
      const [a, b] = [shaft, head].map((part) => part.attributes[name].array);
      const both = new Float32Array(a.length + b.length);
      both.set(a);
      both.set(b, a.length);
      shape.setAttribute(name, new THREE.BufferAttribute(both, 3));
    }
    const offset = shaft.attributes.position.count;
    shape.setIndex([...shaft.index.array, ...Array.from(head.index.array, (i) => i + offset)]);
    return shape;
  }

  update(time) {
    let k = 0;
    while (k + 1 < this.times.length && Math.abs(this.times[k + 1] - time) <= Math.abs(this.times[k] - time)) ++k;
    if (k === this.shown) return;
    this.shown = k;
    const matrix = new THREE.Matrix4(), forward = new THREE.Vector3(0, 0, 1), turn = new THREE.Quaternion();
    for (let i = 0; i < this.n; ++i) {
      const velocity = new THREE.Vector3().fromArray(this.velocities, 3 * (k * this.n + i));
      const speed = velocity.length(), length = this.scale * speed;
      if (speed > 0) turn.setFromUnitVectors(forward, velocity.divideScalar(speed));
      const width = Math.min(this.width, 0.4 * length);
      matrix.compose(new THREE.Vector3().fromArray(this.points, 3 * i), turn, new THREE.Vector3(width, width, length));
      this.mesh.setMatrixAt(i, matrix);
    }
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
