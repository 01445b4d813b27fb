// Where the mechanism plays: camera, light, and the controls of its time.

class Theatre {
  constructor(place, mechanisms) {
    this.mechanisms = mechanisms;
    this.place = place;
    this.renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8088a0, 0.9));
    const sun = new THREE.DirectionalLight(0xffffff, 0.6);
    sun.position.set(2, -3, 4);
    this.scene.add(sun);
    this.size = Math.max(...mechanisms.map((one) => one.size));
    this.center = mechanisms[0].box.getCenter(new THREE.Vector3());
    this.addGround();
    mechanisms.forEach((one) => this.scene.add(one.root));
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    place.append(canvas);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.addEventListener("change", () => this.render());
    this.look("oblique");
    new ResizeObserver(() => this.fit()).observe(place);
    this.fit();
  }

  addGround() {
    const grid = new THREE.GridHelper(5 * this.size, 20, 0x888888, 0x888888);
    grid.material.transparent = true;
    grid.material.opacity = 0.25;
    grid.rotateX(Math.PI / 2);
    grid.position.set(this.center.x, this.center.y, this.mechanisms[0].box.min.z);
    this.scene.add(grid, new THREE.AxesHelper(0.4 * this.size));
  }

  look(name) {
    const far = 2.9 * this.size;
    this.camera.near = 0.01 * this.size;
    this.camera.far = 100 * this.size;
    this.camera.position.set(...kViews[name]).normalize().multiplyScalar(far).add(this.center);
    this.controls.target.copy(this.center);
    this.controls.update();
    this.fit();
  }

  fit() {
    const width = Math.max(this.place.clientWidth, 10);
    const height = Math.max(this.place.clientHeight, 10);
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  // What is not drawn as it is stands in front of the label.
  tell(remark) {
    this.remark = remark;
    this.renderer.domElement.setAttribute("aria-label", remark + this.label);
  }

  show(time) {
    this.mechanisms.forEach((one) => one.show(time));
    this.render();
  }

  render() {
    this.renderer.setClearColor(themeColour("--paper"));
    this.renderer.render(this.scene, this.camera);
  }
}

class Player {
  constructor(theatre, figure) {
    this.theatre = theatre;
    this.begin = theatre.mechanisms[0].times[0];
    this.end = Math.max(...theatre.mechanisms.map((one) => one.times[one.times.length - 1]));
    this.time = this.begin;
    this.isPlaying = false;
    this.speed = 1;
    this.spoken = make("output", {"aria-live": "off"});
    this.driven = this.drivenOf(theatre.mechanisms[0]);
    this.scrub = make("input", {type: "range", min: 0, max: 1000, value: 0, "aria-label": "time",
      oninput: () => this.seek(this.begin + this.scrub.value / 1000 * (this.end - this.begin))});
    this.button = make("button", {type: "button", onclick: () => this.toggle()}, "Play");
    const speeds = choice("speed", kSpeeds.map(String), "1",
                          () => { this.speed = Number(speeds.list.value); });
    const views = choice("view", Object.keys(kViews), "oblique",
                         () => theatre.look(views.list.value));
    const bendings = choice("bending ×", kBendings.map(String), "1",
                            () => this.bend(Number(bendings.list.value)));
    const bends = theatre.mechanisms.some((one) => one.hinges.some(Boolean));
    const runs = theatre.mechanisms.map((one) => make("label", {}, make("input", {type: "checkbox",
      checked: true, onchange: (event) => {
        one.root.visible = event.target.checked;
        theatre.render();
      }}), one.stored.title));
    const isStill = this.end <= this.begin;
    const inTime = isStill ? [] : [this.button, this.scrub, speeds.element];
    figure.append(make("div", {class: "controls"}, ...inTime, views.element,
                       ...(bends ? [bendings.element] : []), ...runs), this.spoken);
    theatre.renderer.domElement.addEventListener("keydown", (event) => this.key(event));
    this.seek(this.begin);
  }

  bend(times) {
    this.theatre.mechanisms.forEach((one) => { one.bending = times; });
    this.theatre.tell(times === 1 ? "" :
      `Flexible links are drawn with ${times} times their bending, other links in their places. `);
    this.seek(this.time);
  }

  // The coordinates that a course drives: {name, unit, history}.
  drivenOf(mechanism) {
    const {history} = mechanism;
    return mechanism.stored.driven.map((name) =>
      ({name, history, unit: history.channels.get(name).unit}));
  }

  // Of the nearest position.
  drivenText() {
    return this.driven.map(({name, unit, history}) =>
      `, ${name} = ${shown(history.at(name, nearest(history.time, this.time)))} ${unit}`).join("");
  }

  key(event) {
    const step = (this.end - this.begin) / (event.shiftKey ? 20 : 200);
    const acts = {" ": () => this.toggle(), ArrowRight: () => this.seek(this.time + step),
                  ArrowLeft: () => this.seek(this.time - step), Home: () => this.seek(this.begin),
                  End: () => this.seek(this.end)};
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }

  toggle() {
    this.isPlaying = !this.isPlaying;
    this.button.textContent = this.isPlaying ? "Pause" : "Play";
    if (!this.isPlaying) return;
    if (this.time >= this.end) this.time = this.begin;
    this.before = performance.now();
    requestAnimationFrame(() => this.advance());
  }

  advance() {
    if (!this.isPlaying) return;
    const now = performance.now();
    const next = this.time + this.speed * (now - this.before) / 1000;
    this.before = now;
    this.seek(next);
    if (next >= this.end) return this.toggle();
    requestAnimationFrame(() => this.advance());
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.scrub.value = Math.round(1000 * (this.time - this.begin) /
                                  Math.max(this.end - this.begin, 1e-12));
    this.spoken.textContent = this.end > this.begin
      ? `${this.theatre.remark}t = ${shown(this.time)} s of ${shown(this.end)} s` +
        this.drivenText()
      : this.theatre.remark + this.theatre.mechanisms[0].stored.title;
    this.theatre.show(this.time);
  }
}

function addMechanism(main) {
  const moving = data.mechanisms.filter((one) => one.poses.length > 0 && one.links.length > 1);
  if (!moving.length) return;
  const names = moving.map((one) => one.title + (one.load_case ? `, ${one.load_case}` : ""));
  const isStill = decode(moving[0].times, Float32Array).length < 2;
  const section = addSection(main, isStill ? "The mechanism" : "The mechanism in motion");
  const place = make("div", {class: "scene"});
  const figure = make("figure", {}, place);
  section.append(figure);
  try {
    const theatre = new Theatre(place, moving.map((one, i) => new Mechanism(one, i > 0)));
    theatre.label =
      `Mechanism of ${moving[0].links.length - 1} links, ${names.join(" over ")}. ` +
      (isStill ? "" : "Space plays, arrow keys move in time.");
    theatre.tell("");
    new Player(theatre, figure);
  } catch (error) {
    place.remove();
    figure.append(make("p", {}, `This browser draws no 3-D (${error.message}).`));
  }
  figure.append(make("figcaption", {}, `${names[0]}${names[1] ? `; ${names[1]} as wires` : ""}. ` +
    "Drag turns, wheel zooms. Closures: first frame orange, second blue, gap and force at the " +
    `first; forces are drawn to the largest of ${isStill ? "all, those of joints green, on the link " +
    "they carry" : "the run"}.`));
}
