"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const { dimension, shapes, runs } = data;
  // The run that goes on for longest gives the times.
  const longest = runs.reduce((a, b) => (Math.abs(b.t.at(-1) - b.t[0]) > Math.abs(a.t.at(-1) - a.t[0]) ? b : a));
  const { t } = longest, last = t.length - 1;
  const byId = (id) => document.getElementById(id);
  const finite = (picture) => picture.every(Number.isFinite);
  let starts = 0;
  for (const shape of shapes) {
    shape.start = starts;
    starts += shape.numbers;
  }
  // The points of a shape in a picture, each of `dimension` numbers; of a circle the radius behind is left out.
  const points = (shape, picture) => {
    const out = [];
    for (let k = shape.start; k + dimension <= shape.start + shape.numbers; k += dimension) {
      out.push(picture.slice(k, k + dimension));
    }
    return out;
  };
  const radius = (shape, picture) => Math.abs(picture[shape.start + shape.numbers - 1]);

  // What shapes of a picture lie in.
  const bounds = (picture, chosen) => {
    const low = Array(dimension).fill(Infinity), high = Array(dimension).fill(-Infinity);
    for (const shape of chosen) {
      const r = shape.kind === "circle" ? radius(shape, picture) : 0;
      for (const point of points(shape, picture)) {
        point.forEach((x, i) => {
          low[i] = Math.min(low[i], x - r);
          high[i] = Math.max(high[i], x + r);
        });
      }
    }
    return { low, high };
  };
  const all = runs.flatMap((run) => run.pictures).filter(finite);
  const low = Array(dimension).fill(Infinity), high = Array(dimension).fill(-Infinity);
  for (const picture of all) {
    const whole = bounds(picture, shapes);
    whole.low.forEach((x, i) => {
      low[i] = Math.min(low[i], x);
      high[i] = Math.max(high[i], whole.high[i]);
    });
  }
  const spans = low.map((x, i) => high[i] - x);
  // Along axes on which the mechanism goes much farther than it is large, the view goes with it; what stands still in each run, perhaps
  // elsewhere in another, is no part of that.
  const rounding = 1e-9 * Math.max(...spans);
  const still = (shape) => runs.every((run) => {
    const [first, ...later] = run.pictures.filter(finite).map((picture) => points(shape, picture).flat());
    return later.every((numbers) => numbers.every((x, i) => Math.abs(x - first[i]) <= rounding));
  });
  const moving = shapes.filter((shape) => !still(shape));
  let extent = 0;
  for (const picture of all) {
    const own = bounds(picture, moving);
    own.low.forEach((x, i) => { extent = Math.max(extent, own.high[i] - x); });
  }
  const follows = spans.map((span) => extent > 0 && span > 8 * extent);
  const travels = follows.includes(true);
  const shown = spans.map((span, i) => (follows[i] ? 3 * extent : span));
  const size = Math.max(...shown) || 1;
  const centre = (picture) => {
    const { low: a, high: b } = travels ? bounds(picture, moving) : { low, high };
    return low.map((x, i) => (follows[i] ? (a[i] + b[i]) / 2 : (x + high[i]) / 2));
  };
  // The distance of lines on the ground that such a view passes: 1, 2 or 5 times a power of ten.
  const mesh = [1, 2, 5, 10].map((k) => k * 10 ** Math.floor(Math.log10(size / 4))).find((x) => x >= size / 4);

  // A spring from p to q as a zigzag whose windings keep their width.
  const zigzag = (p, q, width) => {
    const d = [q[0] - p[0], q[1] - p[1]], length = Math.hypot(...d) || 1;
    const normal = [-d[1] / length * width, d[0] / length * width], turns = 12;
    const out = [p];
    for (let k = 1; k < 2 * turns; k += 2) {
      const s = 0.1 + 0.8 * k / (2 * turns), side = k % 4 === 1 ? 1 : -1;
      out.push([p[0] + s * d[0] + side * normal[0], p[1] + s * d[1] + side * normal[1]]);
    }
    out.push(q);
    return out;
  };

  const svgNode = (name, attributes, parent) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (parent) parent.append(node);
    return node;
  };
  const colours = { ink: "#1c1c1c", line: "#0b4f7d", trace: "#c25a00", soft: "#8a8a8a" };
  // Told apart with every common colour vision.
  const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
  const colour = (k) => (runs.length > 1 ? palette[k % palette.length] : colours.line);

  // The plane: one SVG whose nodes are moved.
  const plane = (stage, pictures) => {
    const margin = 0.08 * size, unit = size / 100;
    const [width, height] = shown.map((span) => span + 2 * margin);
    const svg = svgNode("svg", { role: "img", "aria-label": "the mechanism" });
    const look = (picture) => {
      const [x, y] = centre(picture);
      svg.setAttribute("viewBox", [x - width / 2, -y - height / 2, width, height].join(" "));
    };
    look(all[0] || []);
    stage.append(svg);
    const stroke = (colour, width) => ({
      fill: "none", stroke: colour, "stroke-width": width, "stroke-linejoin": "round", "stroke-linecap": "round",
    });
    const nodes = shapes.map((shape) => {
      switch (shape.kind) {
        case "circle": return svgNode("circle", { ...stroke(colours.line, 0.5 * unit), fill: "#0b4f7d22" }, svg);
        case "mark": return svgNode("circle", { r: 1.2 * unit, fill: colours.line }, svg);
        case "support": return svgNode("path", { fill: colours.soft }, svg);
        case "trace": return svgNode("polyline", { ...stroke(colours.trace, 0.35 * unit), opacity: 0.8 }, svg);
        case "spring": return svgNode("polyline", stroke(colours.ink, 0.35 * unit), svg);
        case "text": {
          const node = svgNode("text", { "font-size": 3.5 * unit, fill: colours.ink }, svg);
          node.textContent = shape.label;
          return node;
        }
        default: return svgNode("polyline", stroke(colours.line, 0.9 * unit), svg);
      }
    });
    const path = (list) => list.map(([x, y]) => `${x},${-y}`).join(" ");
    // Lines that stand still where the view moves.
    const ground = svgNode("path", stroke("#e4e4e4", 0.3 * unit));
    svg.prepend(ground);
    const lines = (picture) => {
      const [x, y] = centre(picture), out = [];
      for (let k = -8; k <= 8; k += 1) {
        const [across, up] = [x, y].map((at) => (Math.round(at / mesh) + k) * mesh);
        if (follows[0]) out.push(`M${across},${-y - 2 * height}v${4 * height}`);
        if (follows[1]) out.push(`M${x - 2 * width},${-up}h${4 * width}`);
      }
      ground.setAttribute("d", out.join(""));
    };
    return (k) => {
      const picture = pictures[k];
      if (!finite(picture)) return;
      if (travels) {
        look(picture);
        lines(picture);
      }
      shapes.forEach((shape, i) => {
        const node = nodes[i], list = points(shape, picture), [x, y] = list[0];
        switch (shape.kind) {
          case "circle":
            node.setAttribute("r", radius(shape, picture));
          // fallthrough
          case "mark":
            node.setAttribute("cx", x);
            node.setAttribute("cy", -y);
            break;
          case "support":
            node.setAttribute("d", `M${x},${-y} l${-2 * unit},${3 * unit} h${4 * unit} z`);
            break;
          case "text":
            node.setAttribute("x", x + unit);
            node.setAttribute("y", -y - unit);
            break;
          case "trace": {
            const shown = byId("traces").checked ? pictures.slice(0, k + 1).filter(finite) : [];
            node.setAttribute("points", path(shown.map((p) => points(shape, p)[0])));
            break;
          }
          case "spring":
            node.setAttribute("points", path(zigzag(list[0], list[1], 1.5 * unit)));
            break;
          default:
            node.setAttribute("points", path(list));
        }
      });
    };
  };

  // Space: a canvas on which what lies behind is painted first; drag turns it, the wheel and two fingers scale it.
  const view = { azimuth: -0.6, height: 0.35, zoom: 1, painters: [] };
  const space = (stage, pictures) => {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "the mechanism; drag to turn it");
    stage.append(canvas);
    let painted = 0;
    const paint = (k) => {
      painted = k;
      const picture = pictures[k];
      if (!finite(picture)) return;
      const { azimuth, height, zoom } = view;
      const ratio = window.devicePixelRatio || 1, { clientWidth: w, clientHeight: h } = canvas;
      canvas.width = w * ratio;
      canvas.height = h * ratio;
      const pen = canvas.getContext("2d");
      pen.scale(ratio, ratio);
      const scale = zoom * 0.8 * Math.min(w, h) / (Math.hypot(...shown) || 1);
      const middle = centre(picture);
      const [ca, sa, ch, sh] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(height), Math.sin(height)];
      // z up; the depth grows away from the eye.
      const seen = (p) => {
        const [x, y, z] = p.map((value, i) => value - middle[i]);
        const right = ca * x - sa * y, away = sa * x + ca * y;
        return [w / 2 + scale * right, h / 2 - scale * (ch * z + sh * away), ch * away - sh * z];
      };
      const items = [];
      const segment = (p, q, colour, width) => items.push({
        depth: (p[2] + q[2]) / 2,
        draw: () => {
          pen.strokeStyle = colour;
          pen.lineWidth = width;
          pen.beginPath();
          pen.moveTo(p[0], p[1]);
          pen.lineTo(q[0], q[1]);
          pen.stroke();
        },
      });
      const disc = (p, r, colour, filled) => items.push({
        depth: p[2],
        draw: () => {
          pen.beginPath();
          pen.arc(p[0], p[1], r, 0, 2 * Math.PI);
          pen.fillStyle = filled;
          pen.fill();
          pen.strokeStyle = colour;
          pen.lineWidth = 1;
          pen.stroke();
        },
      });
      const chain = (list, colour, width) => list.slice(1).forEach((q, i) => segment(list[i], q, colour, width));
      // The ground: a square below, so that it is seen how things lie.
      const side = 0.5 * Math.max(shown[0], shown[1], 1e-9 * size), floor = follows[2] ? middle[2] - shown[2] / 2 : low[2];
      const [x, y] = middle.map((at, i) => (follows[i] ? Math.round(4 * at / side) * side / 4 : at));
      for (let i = -4; i <= 4; i += 1) {
        const s = i / 4 * side;
        chain([seen([x + s, y - side, floor]), seen([x + s, y + side, floor])], "#ececec", 1);
        chain([seen([x - side, y + s, floor]), seen([x + side, y + s, floor])], "#ececec", 1);
      }
      for (const shape of shapes) {
        const list = points(shape, picture).map(seen);
        switch (shape.kind) {
          case "circle": disc(list[0], scale * radius(shape, picture), colours.line, "#d5e3ee"); break;
          case "mark": disc(list[0], 4, colours.line, colours.line); break;
          case "support": disc(list[0], 4, colours.soft, colours.soft); break;
          case "spring": {
            const flat = zigzag(list[0], list[1], 5), depth = (list[0][2] + list[1][2]) / 2;
            chain(flat.map(([x, y]) => [x, y, depth]), colours.ink, 1.2);
            break;
          }
          case "trace":
            if (byId("traces").checked) {
              const path = pictures.slice(0, k + 1).filter(finite).map((p) => seen(points(shape, p)[0]));
              chain(path, colours.trace, 1.2);
            }
            break;
          case "text":
            items.push({
              depth: list[0][2],
              draw: () => {
                pen.fillStyle = colours.ink;
                pen.font = "14px Georgia, serif";
                pen.fillText(shape.label, list[0][0] + 6, list[0][1] - 6);
              },
            });
            break;
          default: chain(list, colours.line, 3);
        }
      }
      pen.lineCap = "round";
      items.sort((a, b) => b.depth - a.depth).forEach((item) => item.draw());
    };
    const held = new Map();
    canvas.addEventListener("pointerdown", (event) => {
      held.set(event.pointerId, [event.clientX, event.clientY]);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const other = [...held].find(([id]) => id !== event.pointerId);
      const now = [event.clientX, event.clientY];
      if (other) {
        const apart = (p) => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]) || 1;
        view.zoom *= apart(now) / apart(before);
      } else {
        view.azimuth += 0.01 * (now[0] - before[0]);
        view.height = Math.max(-1.5, Math.min(1.5, view.height + 0.01 * (now[1] - before[1])));
      }
      held.set(event.pointerId, now);
      view.painters.forEach((again) => again());
    });
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, (event) => held.delete(event.pointerId));
    }
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      view.zoom *= Math.exp(-0.001 * event.deltaY);
      view.painters.forEach((again) => again());
    }, { passive: false });
    view.painters.push(() => paint(painted));
    window.addEventListener("resize", () => paint(painted));
    return paint;
  };

  // A quantity of all runs over time, with a cursor; `scaled` is how its numbers are drawn.
  const from = t[0], span = t[last] - from || 1;
  const strip = (name, lists, scaled = (x) => x, unit = "") => {
    const known = (x) => x !== null && Number.isFinite(x);
    const all = lists.flat().filter(known);
    if (!all.length) return () => {};
    const [min, max] = all.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
    const svg = svgNode("svg", { viewBox: "0 0 800 80", preserveAspectRatio: "none", role: "img", "aria-label": name });
    const at = (time) => 800 * (time - from) / span;
    const [bottom, top] = [scaled(min), scaled(max)];
    const level = (x) => 74 - 50 * (top > bottom ? (scaled(x) - bottom) / (top - bottom) : 0.5);
    lists.forEach((values, k) => {
      const path = values.map((x, i) => [x, runs[k].t[i]]).filter(([x]) => known(x));
      svgNode("polyline", {
        points: path.map(([x, time]) => `${at(time)},${level(x)}`).join(" "),
        fill: "none", stroke: colour(k), "stroke-width": 1.2, "vector-effect": "non-scaling-stroke",
      }, svg);
    });
    const cursor = svgNode("line", {
      y1: 20, y2: 80, stroke: colours.ink, "stroke-width": 1, "vector-effect": "non-scaling-stroke",
    }, svg);
    const label = document.createElement("div");
    label.className = "soft";
    byId("strips").append(label, svg);
    const number = (y) => (known(y) ? String(Number(y.toPrecision(3))) : "–");
    return (time, places) => {
      cursor.setAttribute("x1", at(time));
      cursor.setAttribute("x2", at(time));
      const now = lists.map((values, k) => {
        const item = document.createElement("span");
        item.textContent = number(values[places[k]]);
        item.style.color = runs.length > 1 ? colour(k) : "";
        return item;
      });
      label.replaceChildren(`${name} `, ...now.flatMap((item) => [item, " "]), `${unit} (${number(min)} to ${number(max)})`);
    };
  };

  // The place in `run` that is the last at or before `time`; times grow, or fall in motions backward.
  const place = (run, time) => {
    let low = 0, high = run.t.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (span > 0 ? run.t[middle] <= time : run.t[middle] >= time) low = middle; else high = middle - 1;
    }
    return low;
  };
  byId("stage").classList.toggle("several", runs.length > 1);
  const panels = runs.map((run, k) => {
    const panel = document.createElement("figure");
    byId("stage").append(panel);
    const show = (dimension === 3 ? space : plane)(panel, run.pictures);
    const along = travels && dimension === 2 ? `The view goes along; its lines are ${mesh} apart` : "";
    if (run.label || run.ended || along) {
      const caption = document.createElement("figcaption");
      caption.textContent = [run.label, run.ended, along].filter(Boolean).join(". ");
      if (runs.length > 1) caption.style.borderColor = colour(k);
      panel.append(caption);
    }
    return show;
  });
  const changed = (values) => values.map((x) => (x === null || values[0] === null ? null : x - values[0]));
  const energy = runs.length > 1 ? "" : ` ${Number(Number(runs[0].energy[0]).toPrecision(7))}${data.energy_unit}`;
  const strips = [strip(`energy${energy}, changed by`, runs.map((run) => changed(run.energy)), undefined, data.energy_unit)];
  if (runs[0].residual.length) {
    const digits = (x) => Math.log10(Math.max(x, 1e-18));
    strips.push(strip("largest constraint residual, by powers of ten,", runs.map((run) => run.residual), digits));
  }
  const slider = byId("time"), play = byId("play");
  slider.max = last;
  let playing = false, time = t[0], clock = 0;
  const draw = (k) => {
    const places = runs.map((run) => place(run, t[k]));
    panels.forEach((show, i) => show(places[i]));
    strips.forEach((update) => update(t[k], places));
    byId("now").textContent = `t = ${t[k].toFixed(3)} s`;
    slider.value = k;
  };
  const frame = (now) => {
    if (!playing) return;
    const step = Number(byId("speed").value) * (now - clock) / 1000;
    clock = now;
    time += span > 0 ? step : -step;
    const k = place(longest, time);
    draw(k);
    if (k === last) stop(); else requestAnimationFrame(frame);
  };
  const stop = () => {
    playing = false;
    play.textContent = "Play";
  };
  play.addEventListener("click", () => {
    if (playing) return stop();
    if (Number(slider.value) === last) time = t[0];
    playing = true;
    play.textContent = "Pause";
    clock = performance.now();
    requestAnimationFrame(frame);
  });
  slider.addEventListener("input", () => {
    time = t[Number(slider.value)];
    draw(Number(slider.value));
  });
  byId("traces").addEventListener("change", () => draw(Number(slider.value)));
  // `#k` in the address shows picture k.
  const wished = Number(location.hash.slice(1));
  const first = Number.isInteger(wished) ? Math.max(0, Math.min(last, wished)) : 0;
  time = t[first];
  draw(first);
})();
