"use strict";

// Where the fibers stand: camera, light, and the small axes in a corner.

const cameraPlaces = {
  // in words, from where the camera looks, and what is up
  front: { words: "plane of x and y", from: [0, 0, 1], up: [0, 1, 0] },
  above: { words: "plane of x and z", from: [0, 1, 0], up: [0, 0, -1] },
  along: { words: "along x", from: [1, 0, 0], up: [0, 1, 0] },
  oblique: { words: "oblique", from: [0.55, 0.45, 0.75], up: [0, 1, 0] },
};

/// Does a processor draw? It takes half of its time to smooth edges.
function isDrawnBySoftware() {
  const gl = document.createElement("canvas").getContext("webgl"), named = gl && gl.getExtension("WEBGL_debug_renderer_info");
  return Boolean(named) && /swiftshader|llvmpipe|softpipe|software/i.test(gl.getParameter(named.UNMASKED_RENDERER_WEBGL));
}

class Stage {
  constructor(holder) {
    this.holder = holder;
    this.renderer = new THREE.WebGLRenderer({ antialias: !isDrawnBySoftware() });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setClearColor(0xfafafa);
    holder.insertBefore(this.renderer.domElement, holder.firstChild);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x707888, 0.62), this.camera);
    const lamp = new THREE.DirectionalLight(0xffffff, 0.42);
    lamp.position.set(0.6, 0.9, 1.0);
    this.camera.add(lamp);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.render());
    this.resize();
  }

  /// From how far a ball fills the view. @param half  its radius, length
  distanceOfBall(half) {
    return (1.08 * half) / Math.sin((Math.PI / 180) * 15) / Math.min(1, this.camera.aspect);
  }

  /// From how far points fill the view. @param points  [points][3]
  distanceOfPoints(place, middle, points) {
    const { from, up } = cameraPlaces[place], back = new THREE.Vector3(...from).normalize();
    const right = new THREE.Vector3(...up).cross(back).normalize(), over = back.clone().cross(right);
    const slope = Math.tan((Math.PI / 180) * 15) / 1.1, point = new THREE.Vector3(), origin = new THREE.Vector3(...middle);
    let distance = 0;
    for (let i = 0; i < points.length; i += 3) {
      point.fromArray(points, i).sub(origin);
      const seen = Math.max(Math.abs(point.dot(over)), Math.abs(point.dot(right)) / this.camera.aspect);
      distance = Math.max(distance, seen / slope + point.dot(back));
    }
    return distance;
  }

  /// @param middle  [3] of what is looked at
  lookFrom(place, middle, distance) {
    const { from, up } = cameraPlaces[place], size = Math.hypot(...from);
    this.camera.up.set(...up);
    this.controls.target.set(...middle);
    this.camera.position.set(...middle.map((c, i) => c + (from[i] / size) * distance));
    this.camera.near = 1e-3 * distance;
    this.camera.far = 1e2 * distance;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.render();
  }

  /// Moves what is looked at, and the camera with it.
  follow(middle) {
    const step = new THREE.Vector3(...middle).sub(this.controls.target);
    this.controls.target.add(step);
    this.camera.position.add(step);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.render();
  }

  render() {
    this.renderer.render(this.scene, this.camera);
    if (!this.drawnFrom || !this.drawnFrom.equals(this.camera.quaternion)) this.drawAxes(document.getElementById("axes"));
  }

  drawAxes(canvas) {
    this.drawnFrom = this.camera.quaternion.clone();
    const context = canvas.getContext("2d"), turn = this.drawnFrom.clone().inverse();
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.font = "12px sans-serif";
    const axes = [["x", "#c0392b", 1, 0, 0], ["y", "#27803b", 0, 1, 0], ["z", "#2b59c3", 0, 0, 1]].map(
      ([name, colour, ...d]) => ({ name, colour, at: new THREE.Vector3(...d).applyQuaternion(turn) }));
    for (const { name, colour, at } of axes.sort((a, b) => a.at.z - b.at.z)) {
      const [x, y] = [40 + 26 * at.x, 40 - 26 * at.y];
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 2;
      context.beginPath();
      context.moveTo(40, 40);
      context.lineTo(x, y);
      context.stroke();
      context.fillText(name, x + 7 * at.x - 3, y - 7 * at.y + 4);
    }
  }
}
