// The mechanism in motion. Links are the solids they were given (shape.js), or bars from joint to
// joint with a ball at their centre of mass; joints are shapes by type, closures show both of their frames, the gap between them and the
// force there. Runs lie over each other: the second is drawn as wires.

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5];
const kViews = {oblique: [1, -1.4, 0.9], "along x": [1, 0, 0], "along y": [0, -1, 0],
                "along z": [0, -0.001, 1]};

const kBendings = [1, 10, 100, 1000];  // as many times the bending of flexible links is drawn

const kSliding = ["prismatic", "cylindrical", "screw", "planar"];

function frameMatrix(numbers, offset = 0) {
  const [x, y, z, w, i, j, k] = numbers.slice(offset, offset + 7);
  return new THREE.Matrix4().compose(new THREE.Vector3(x, y, z),
    new THREE.Quaternion(i, j, k, w), new THREE.Vector3(1, 1, 1));
}

function positionOf(frame) {
  return new THREE.Vector3(frame[0], frame[1], frame[2]);
}

class Mechanism {
  constructor(stored, isGhost) {
    this.stored = stored;
    this.isGhost = isGhost;
    this.times = decode(stored.times, Float32Array);
    this.poses = decode(stored.poses, Float32Array);
    this.history = histories.find((one) => one.isAgain && one.name === stored.history) ?? null;
    this.hinges = stored.links.map((_, i) =>
      stored.joints.find((joint) => joint.bends && joint.child === i) ?? null);
    this.bending = 1;
    this.shapes = this.makeShapes();
    this.size = this.extent();
    this.root = new THREE.Group();
    this.links = stored.links.map((link, i) => this.addLink(link, i));
    this.shapes.forEach((shape) => this.addShape(shape));
    stored.joints.forEach((joint) => this.addJoint(joint));
    this.rails = stored.joints.filter((joint) => kSliding.includes(joint.type))
      .map((joint) => this.addRail(joint));
    this.springs = stored.springs.map((spring) => this.addSpring(spring));
    this.closures = stored.closures.map((closure) => this.addClosure(closure));
    this.reactions = this.times.length < 2 ? this.addReactions() : [];
    stored.points.forEach((point) => this.addPath(point));
    this.show(this.times[0]);
  }

  // Half of the diagonal of the box in which joints, centres of mass, points and shapes move.
  extent() {
    const box = new THREE.Box3();
    const {joints, closures, springs, links, points} = this.stored;
    const addBox = (link, part) => {
      for (let i = 0; i < this.times.length; i += Math.ceil(this.times.length / 60)) {
        box.union(part.clone().applyMatrix4(this.poseAt(link, i)));
      }
    };
    const add = (link, place) => addBox(link, new THREE.Box3(place, place));
    joints.forEach((joint) => add(joint.parent, positionOf(joint.parent_frame)));
    closures.forEach((one) => add(one.first, positionOf(one.first_frame)));
    springs.forEach((one) => {
      add(one.first, new THREE.Vector3(...one.first_position));
      add(one.second, new THREE.Vector3(...one.second_position));
    });
    points.forEach((point) => add(point.link, new THREE.Vector3(...point.position)));
    links.forEach((link, i) => link.center && add(i, new THREE.Vector3(...link.center)));
    this.shapes.forEach(({link, geometry}) => addBox(link, geometry.boundingBox));
    this.box = box;
    return Math.max(box.getSize(new THREE.Vector3()).length() / 2, 1e-6);
  }

  poseAt(link, instant) {
    return frameMatrix(this.poses, 7 * (instant * this.stored.links.length + link));
  }

  material(colour) {
    return new THREE.MeshStandardMaterial({color: colour, roughness: 0.6, metalness: 0.1,
      wireframe: this.isGhost, transparent: this.isGhost, opacity: this.isGhost ? 0.5 : 1});
  }

  place(parent, geometry, colour, matrix) {
    const mesh = new THREE.Mesh(geometry, this.material(colour));
    mesh.applyMatrix(matrix);
    parent.add(mesh);
    return mesh;
  }

  bar(parent, from, to, radius, colour) {
    const length = from.distanceTo(to);
    if (length < 1e-3 * this.size) return;
    const geometry = new THREE.CylinderBufferGeometry(radius, radius, length, 10);
    this.place(parent, geometry, colour, fromTo(from, to));
  }

  // Where something is attached, in the link frame; where its tree joint holds it comes first.
  attachments(link) {
    const {joints, closures, springs} = this.stored;
    return [
      ...joints.filter((j) => j.child === link).map((j) => positionOf(j.child_frame)),
      ...joints.filter((j) => j.parent === link).map((j) => positionOf(j.parent_frame)),
      ...closures.filter((c) => c.first === link).map((c) => positionOf(c.first_frame)),
      ...closures.filter((c) => c.second === link).map((c) => positionOf(c.second_frame)),
      ...springs.filter((s) => s.first === link)
        .map((s) => new THREE.Vector3(...s.first_position)),
      ...springs.filter((s) => s.second === link)
        .map((s) => new THREE.Vector3(...s.second_position))];
  }

  colourOf(link) {
    return kColours[(link - 1) % kColours.length];
  }

  // Of an element of a flexible link, the one with the link's own joint.
  rootOf(link) {
    return this.hinges[link] ? this.rootOf(this.hinges[link].parent) : link;
  }

  isShaped(link) {
    return this.stored.links[this.rootOf(link)].shape.length > 0;
  }

  // Of every solid: its link, the elements that it is drawn on, its geometry in the link frame.
  makeShapes() {
    const {links} = this.stored;
    return links.flatMap(({shape}, link) => {
      const elements = [...links.keys()].filter((i) => this.rootOf(i) === link);
      const beam = elements.length > 1 ? new BentBeam(
        elements.map((i) => this.hinges[i]).filter(Boolean)) : null;
      beam?.sort(elements, (i) => links[i].center);
      return shape.map((solid) => ({link, elements, geometry: solidGeometry(solid, beam)}));
    });
  }

  addShape({link, elements, geometry}) {
    const material = this.material(this.colourOf(link));
    if (elements.length === 1) {
      this.links[link].add(new THREE.Mesh(geometry, material));
      return;
    }
    this.root.add(bentMesh(geometry, material, elements.map((i) => this.links[i])));
  }

  addLink(link, i) {
    const group = new THREE.Group();
    group.matrixAutoUpdate = false;
    this.root.add(group);
    if (!link.center || this.isShaped(i)) return group;  // no centre: ground
    const colour = this.colourOf(i);
    const [from, ...rest] = this.attachments(i);
    const center = new THREE.Vector3(...link.center);
    for (const to of rest.length ? rest : [center]) {
      this.bar(group, from ?? center, to, 0.018 * this.size, colour);
    }
    this.place(group, new THREE.SphereBufferGeometry(0.028 * this.size, 14, 10), colour,
               new THREE.Matrix4().setPosition(center));
    return group;
  }

  jointShape(type) {
    const r = 0.045 * this.size;
    const lying = (geometry) => geometry.rotateX(Math.PI / 2);  // along z
    const shapes = {
      revolute: () => lying(new THREE.CylinderBufferGeometry(r, r, 2.2 * r, 16)),
      prismatic: () => new THREE.BoxBufferGeometry(1.5 * r, 1.5 * r, 3 * r),
      cylindrical: () => lying(new THREE.CylinderBufferGeometry(0.8 * r, 0.8 * r, 3.5 * r, 16)),
      screw: () => lying(new THREE.CylinderBufferGeometry(0.8 * r, 0.4 * r, 3.5 * r, 8)),
      universal: () => new THREE.OctahedronBufferGeometry(1.4 * r),
      spherical: () => new THREE.SphereBufferGeometry(1.1 * r, 16, 12),
      pin_in_slot: () => lying(new THREE.CylinderBufferGeometry(0.6 * r, 0.6 * r, 4 * r, 8)),
      rod: () => new THREE.SphereBufferGeometry(0.6 * r, 16, 12),
      planar: () => new THREE.BoxBufferGeometry(3 * r, 3 * r, 0.4 * r),
      fixed: () => new THREE.BoxBufferGeometry(r, r, r),
    };
    return shapes[type] ? shapes[type]() : new THREE.TetrahedronBufferGeometry(r);
  }

  addJoint(joint) {
    if (joint.type === "free" || (joint.bends && this.isShaped(joint.child))) return;
    const matrix = frameMatrix(joint.parent_frame);
    this.place(this.links[joint.parent], this.jointShape(joint.type), "#8a9099", matrix);
  }

  // From where a joint is to where it has slid.
  addRail(joint) {
    const line = this.addLine("#8a9099");
    return {line, ends: [{link: joint.parent, local: frameMatrix(joint.parent_frame)},
                         {link: joint.child, local: frameMatrix(joint.child_frame)}]};
  }

  // Between its two points.
  addSpring(spring) {
    const end = (link, place) => (
      {link, local: new THREE.Matrix4().setPosition(new THREE.Vector3(...place))});
    return {line: this.addLine(this.isGhost ? "#56b4e9" : "#e69f00"),
            ends: [end(spring.first, spring.first_position),
                   end(spring.second, spring.second_position)]};
  }

  addLine(colour) {
    const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(
      [new THREE.Vector3(), new THREE.Vector3()]), new THREE.LineBasicMaterial({color: colour}));
    line.frustumCulled = false;
    this.root.add(line);
    return line;
  }

  placesOf(ends) {
    return ends.map(({link, local}) => new THREE.Vector3()
      .setFromMatrixPosition(this.links[link].matrix.clone().multiply(local)));
  }

  // The axis of a closure is its x.
  addClosure(closure) {
    const turn = new THREE.Matrix4().makeRotationY(Math.PI / 2);
    const ends = [[closure.first, closure.first_frame], [closure.second, closure.second_frame]];
    const frames = ends.map(([link, frame], i) => {
      const matrix = frameMatrix(frame);
      const mesh = this.place(this.links[link], this.jointShape(closure.type),
                              i === 0 ? "#d55e00" : "#0072b2", matrix.clone().multiply(turn));
      mesh.scale.setScalar(i === 0 ? 0.8 : 1.05);
      mesh.material.transparent = true;
      mesh.material.opacity = i === 0 ? 1 : 0.4;
      const axes = new THREE.AxesHelper(0.15 * this.size);
      axes.applyMatrix(matrix);
      this.links[link].add(axes);
      return {link, local: matrix};
    });
    const gap = this.addLine("#cc79a7");
    const owner = `closure.${closure.name}`;
    return {frames, gap, force: this.addForce(owner, this.isGhost ? "#56b4e9" : "#d55e00",
                                              this.largestForce(owner))};
  }

  // Of a mechanism at rest every joint's, all to one scale.
  addReactions() {
    const owners = this.stored.joints.map((joint) => `joint.${joint.name}`);
    const closures = this.stored.closures.map((closure) => `closure.${closure.name}`);
    const largest = Math.max(0, ...[...owners, ...closures].map((one) => this.largestForce(one)));
    this.closures.forEach((closure) => { closure.force.largest = largest; });
    return this.stored.joints.map((joint, i) => ({
      end: {link: joint.child, local: frameMatrix(joint.child_frame)},
      force: this.addForce(owners[i], "#009e73", largest)}));
  }

  addForce(owner, colour, largest) {
    const arrow = new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 1, colour);
    this.root.add(arrow);
    return {names: this.forceNames(owner), arrow, largest};
  }

  forceNames(owner) {
    const names = ["x", "y", "z"].map((axis) => `${owner}.force.${axis}`);
    return this.history && names.every((name) => this.history.channels.has(name)) ? names : null;
  }

  largestForce(owner) {
    const names = this.forceNames(owner);
    if (!names) return 0;
    return Math.max(...names.map((name) => this.history.samples(name).values.reduce(
      (most, value) => (Number.isFinite(value) ? Math.max(most, Math.abs(value)) : most), 0)));
  }

  // The way of a watched point over the whole run.
  addPath(point) {
    const places = [];
    for (let i = 0; i < this.times.length; ++i) {
      places.push(new THREE.Vector3(...point.position).applyMatrix4(this.poseAt(point.link, i)));
    }
    this.root.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(places),
      new THREE.LineBasicMaterial({color: this.isGhost ? "#56b4e9" : "#009e73"})));
  }

  instantOf(time) {
    const low = lastUpTo(this.times, time);
    const high = Math.min(low + 1, this.times.length - 1);
    const width = this.times[high] - this.times[low];
    const part = width > 0 ? Math.min(Math.max((time - this.times[low]) / width, 0), 1) : 0;
    return {low, high, part};
  }

  // Of every link between two stored instants.
  posesAt(time) {
    const {low, high, part} = this.instantOf(time);
    const [p, q, s] = [new THREE.Vector3(), new THREE.Quaternion(), new THREE.Vector3()];
    const [p2, q2] = [new THREE.Vector3(), new THREE.Quaternion()];
    return this.links.map((_, i) => {
      this.poseAt(i, low).decompose(p, q, s);
      this.poseAt(i, high).decompose(p2, q2, s);
      return new THREE.Matrix4().compose(p.lerp(p2, part), q.slerp(q2, part), s);
    });
  }

  // The turn of every hinge of a flexible link, `bending` times as large about the same axis: the
  // elements stay joined, and the one that holds the others stays in its place.
  bent(poses, i) {
    const hinge = this.hinges[i];
    if (!hinge || this.bending === 1) return poses[i];
    const [outer, inner] = [frameMatrix(hinge.parent_frame), frameMatrix(hinge.child_frame)];
    const inverse = (matrix) => new THREE.Matrix4().getInverse(matrix);
    const turn = inverse(poses[hinge.parent].clone().multiply(outer))
      .multiply(poses[i]).multiply(inner);
    const q = new THREE.Quaternion().setFromRotationMatrix(turn);
    if (q.w < 0) q.set(-q.x, -q.y, -q.z, -q.w);
    const axis = new THREE.Vector3(q.x, q.y, q.z);
    const angle = 2 * Math.atan2(axis.length(), q.w) * this.bending;
    return this.bent(poses, hinge.parent).clone().multiply(outer)
      .multiply(new THREE.Matrix4().makeRotationAxis(axis.normalize(), angle))
      .multiply(inverse(inner));
  }

  show(time) {
    const poses = this.posesAt(time);
    this.links.forEach((group, i) => {
      group.matrix.copy(this.bent(poses, i));
      group.matrixWorldNeedsUpdate = true;
    });
    [...this.rails, ...this.springs].forEach((rail) => rail.line.geometry.setFromPoints(this.placesOf(rail.ends)));
    this.closures.forEach((closure) => this.showClosure(closure, time));
    this.reactions.forEach(({end, force}) => this.showForce(force, this.placesOf([end])[0], time));
  }

  showClosure(closure, time) {
    const ends = this.placesOf(closure.frames);
    closure.gap.geometry.setFromPoints(ends);
    this.showForce(closure.force, ends[0], time);
  }

  showForce({names, arrow, largest}, place, time) {
    const row = names ? nearest(this.history.time, time) : 0;
    const force = names ? new THREE.Vector3(...names.map((n) => this.history.at(n, row))) : null;
    const isThere = force !== null && force.length() > 1e-3 * largest;
    arrow.visible = isThere;
    if (!isThere) return;
    arrow.position.copy(place);
    arrow.setDirection(force.clone().normalize());
    const length = 0.8 * this.size * force.length() / largest;
    arrow.setLength(length, Math.min(0.3 * length, 0.08 * this.size),
                    Math.min(0.15 * length, 0.04 * this.size));
  }
}
