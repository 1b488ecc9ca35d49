// Values under the pointer, and any slice of the table; the page says the same without it.
"use strict";
(async () => {
  const about = JSON.parse(document.getElementById("about").textContent);
  const link = document.getElementById("table");
  if (!link || typeof DecompressionStream === "undefined") return;

  // ---- the table: columns by name, rows in the order of the dimensions -------------------------------------
  const bytes = Uint8Array.from(atob(link.href.split(",")[1]), (c) => c.charCodeAt(0));
  const text = await new Response(
    new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))
  ).text();
  link.href = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  link.download = link.download.replace(/\.gz$/, "");
  const cells = (line) => (line.includes('"') ? quoted(line) : line.split(","));
  const quoted = (line) =>
    [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map((m) => m[1].replace(/^"|"$/g, "").replaceAll('""', '"'));
  const lines = text.trimEnd().split("\n").map(cells);
  const table = {};
  lines[0].forEach((name, i) => {
    const column = lines.slice(1).map((line) => line[i]);
    const numbers = column.map((cell) => (cell === "" ? NaN : cell === "inf" ? Infinity : Number(cell)));
    table[name] = column.every((cell, k) => cell === "" || !Number.isNaN(numbers[k])) ? numbers : column;
  });
  Object.entries(about.derived).forEach(([name, values]) => (table[name] = values.map((v) => v ?? NaN)));

  const dims = about.dims;
  const dim = Object.fromEntries(dims.map((d) => [d.name, d]));
  dims.reduceRight((stride, d) => ((d.stride = stride), stride * d.size), 1);
  const known = { ...about.columns, ...dim };
  const rowsAt = (fixed, x, hue) => {
    const along = dim[x] ?? dim.sample;
    const base = dims.reduce((sum, d) => sum + (d === along || d.name === hue ? 0 : (fixed[d.name] ?? 0) * d.stride), 0);
    const each = hue ? [...Array(dim[hue].size).keys()] : [0];
    return each.map((k) => [...Array(along.size).keys()].map((i) => base + i * along.stride + (hue ? k * dim[hue].stride : 0)));
  };

  // ---- words ------------------------------------------------------------------------------------------------
  const raised = (n) => String(n).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  const short = (value, digits = 4) => {
    if (typeof value !== "number") return String(value).replaceAll("_", " ");
    if (!Number.isFinite(value)) return value === Infinity ? "∞" : "–";
    const [lead, power] = value.toExponential(digits - 1).split("e");
    if (value === 0 || (power > -4 && power < 6)) return String(Number(value.toPrecision(Math.max(digits, Number(power) + 1)))).replace("-", "−");
    return (Number(lead) === 1 ? "" : String(Number(lead)).replace("-", "−") + "·") + "10" + raised(Number(power));
  };
  const escaped = (words) => words.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
  const index = (d, row) => Math.floor(row / d.stride) % d.size;
  const words = (name, row) => {
    const about = known[name];
    if (about?.words?.length) return escaped(about.words[index(about, row)]);
    const value = table[name]?.[row];
    return escaped(about?.rad && value ? short(value / Math.PI, 3) + "π" : short(value));
  };
  const unit = (name) => (known[name]?.unit ? " " + escaped(known[name].unit) : "");
  const symbol = (name) => known[name]?.symbol ?? escaped(name);
  const label = (name) => symbol(name) + (known[name]?.unit ? ` (${escaped(known[name].unit)})` : "");
  const errorOf = (name) => (name.startsWith("s/s") ? name + "_error" : name.replace(/(\[.*)?$/, "_error$1"));
  const describe = (y, row) => {
    const error = table[errorOf(y)]?.[row];
    const about = error > 0 ? " ± " + short(error, 2) : "";
    const places = Object.values(known).filter((d) => d.name ? d.size > 1 && d.name !== "sample" : d.sampled);
    const names = places.map((d) => d.name ?? Object.keys(known).find((n) => known[n] === d));
    const where = names.map((n) => `${symbol(n)} = ${words(n, row)}${unit(n)}`);
    const regime = table.regime && y !== "regime" ? [words("regime", row)] : [];
    return [`<b>${symbol(y)} = ${words(y, row)}${about}${unit(y)}</b>`, ...where, ...regime].join("<br>");
  };

  // ---- a dot and a card at the point nearest to the pointer, or by the arrow keys -----------------------------
  const attach = (stage, points, y) => {
    const dot = Object.assign(document.createElement("span"), { className: "dot", hidden: true });
    const card = Object.assign(document.createElement("div"), { className: "card", hidden: true });
    card.setAttribute("role", "status");
    stage.append(dot, card);
    let at = null;
    const show = (found) => {
      at = found;
      dot.hidden = card.hidden = !found;
      if (!found) return;
      const box = stage.getBoundingClientRect();
      dot.style.left = card.style.left = found.left * 100 + "%";
      dot.style.top = card.style.top = found.top * 100 + "%";
      card.className = "card" + (found.left * box.width > box.width - 190 ? " left" : "") + (found.top > 0.6 ? " up" : "");
      card.innerHTML = describe(y(found), found.row);
    };
    const nearest = (left, top) => {
      const box = stage.getBoundingClientRect();
      let best = null, least = Infinity;
      for (const point of points(left, top)) {
        const far = Math.hypot((point.left - left) * box.width, (point.top - top) * box.height);
        if (far < least) [least, best] = [far, point];
      }
      return best;
    };
    const follow = (event) => {
      const box = stage.getBoundingClientRect();
      show(nearest((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height));
    };
    stage.addEventListener("pointermove", follow);
    stage.addEventListener("pointerdown", follow);
    stage.addEventListener("pointerleave", () => show(null));
    stage.addEventListener("blur", () => show(null));
    stage.tabIndex = 0;
    stage.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const from = at ?? { left: 0.5, top: 0.5 };
      const ahead = [...points(from.left, from.top)].filter((p) => (p.left - from.left) * step[0] + (p.top - from.top) * step[1] > 1e-9);
      const far = (p) => Math.abs(p.left - from.left) * (step[0] ? 1 : 9) + Math.abs(p.top - from.top) * (step[1] ? 1 : 9);
      if (ahead.length) show(ahead.reduce((a, b) => (far(b) < far(a) ? b : a)));
    });
    return () => show(null);
  };

  // ---- the study's figure ---------------------------------------------------------------------------------
  const share = (value, [low, high], log) =>
    log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  const place = (panel, name, row) => (panel.cells || typeof table[name][row] !== "number" ? index(dim[name], row) : table[name][row]);
  const figure = document.getElementById("plot");
  if (figure && about.panels.length) {
    for (const panel of about.panels) {
      const [x, y] = panel.upright ? [panel.y, panel.x] : [panel.x, panel.y];
      panel.points = rowsAt(panel.fixed, panel.x, panel.lines ? panel.hue : panel.y).flat().map((row) => {
        const across = share(place(panel, x, row), panel.ends.slice(0, 2), panel.log[0]);
        const up = share(place(panel, y, row), panel.ends.slice(2), panel.log[1]);
        const [left, top, width, height] = panel.box;
        return { row, panel, left: left + across * width, top: top + (1 - up) * height };
      }).filter((p) => Number.isFinite(p.left + p.top));
    }
    const inside = (panel, left, top) =>
      left > panel.box[0] && left < panel.box[0] + panel.box[2] && top > panel.box[1] && top < panel.box[1] + panel.box[3];
    attach(figure, (left, top) => (about.panels.find((p) => inside(p, left, top)) ?? { points: [] }).points, (p) => p.panel.value);
  }

  // ---- any slice: what is on the axes, and a drop-down for what is not --------------------------------------
  const room = document.getElementById("slice");
  const axes = [...dims.filter((d) => d.size > 1 && d.name !== "sample").map((d) => d.name), ...Object.keys(known).filter((n) => known[n].sampled)];
  const values = Object.keys(known).filter((n) => !dim[n] && !known[n].sampled && !n.includes("_error") && (known[n].flags || typeof table[n].find((v) => v !== "") === "number"));
  values.push(...Object.keys(about.derived).filter((n) => !n.endsWith("_error")));
  if (!room || !axes.length || !values.length) return;
  document.querySelectorAll("[data-script]").forEach((each) => (each.hidden = false));
  const few = axes.filter((n) => dim[n] && dim[n].size <= 12);
  const sampled = Boolean(dim.sample);
  const state = { y: about.start.y, x: axes.includes(about.start.x) ? about.start.x : axes.find((n) => known[n].sampled) ?? axes[0], hue: about.start.hue ?? "", fixed: { ...about.start.fixed } };
  if (!values.includes(state.y)) state.y = values[0];
  if (!few.includes(state.hue) || state.hue === state.x) state.hue = "";

  const controls = room.querySelector(".controls"), stage = room.querySelector(".stage"), legend = room.querySelector(".legend");
  const plain = (html) => Object.assign(document.createElement("span"), { innerHTML: html }).textContent;
  const choice = (label, options, chosen, act) => {
    const select = document.createElement("select");
    options.forEach(([value, words]) => select.add(new Option(words, value, false, String(value) === String(chosen))));
    select.addEventListener("change", () => (act(select.value), draw()));
    const whole = document.createElement("label");
    whole.innerHTML = `<span>${label}</span>`;
    whole.append(select);
    controls.append(whole);
  };
  const titled = (n) => [n, [...new Set([plain(symbol(n)), known[n]?.meaning ?? ""])].filter(Boolean).join(" – ")];
  const menu = () => {
    controls.replaceChildren();
    choice("upwards", values.map(titled), state.y, (v) => (state.y = v));
    choice("across", axes.map(titled), state.x, (v) => ((state.x = v), state.hue === v && (state.hue = "")));
    const lines = few.filter((n) => n !== state.x);
    if (lines.length) choice(sampled ? "colours" : "lines", [["", "one"], ...lines.map(titled)], state.hue, (v) => (state.hue = v));
    for (const d of dims.filter((d) => d.size > 1 && ![state.x, state.hue, "sample"].includes(d.name))) {
      const options = [...Array(d.size).keys()].map((i) => [i, plain(words(d.name, i * d.stride)) + (d.unit ? " " + d.unit : "")]);
      choice(d.symbol, options, state.fixed[d.name] ?? 0, (v) => (state.fixed[d.name] = Number(v)));
    }
  };

  const ticks = (low, high, log, rad, most) => {
    const found = [];
    if (log) {
      for (let p = Math.floor(Math.log10(low)); p <= Math.log10(high); p++)
        for (const d of high / low < 1e3 ? [1, 2, 5] : [1]) found.push(d * 10 ** p);
    } else {
      const one = rad ? Math.PI : 1, rough = (high - low) / most / one, power = 10 ** Math.floor(Math.log10(rough));
      const step = (rad ? [0.25, 0.5, 1, 2].find((s) => s >= rough) ?? Math.ceil(rough) : power * [1, 2, 5, 10].find((s) => s * power >= rough * 0.999)) * one;
      for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) found.push(Math.abs(v) < 1e-9 * step ? 0 : v);
    }
    return found.filter((v) => v >= low * (1 - 1e-9) - 1e-12 && v <= high * (1 + 1e-9) + 1e-12);
  };
  const inPi = (v) => {
    const quarters = Math.round((v / Math.PI) * 4), n = quarters % 4 ? (quarters % 2 ? [quarters, 4] : [quarters / 2, 2]) : [quarters / 4, 1];
    return quarters === 0 ? "0" : (n[0] === 1 ? "" : n[0] === -1 ? "−" : n[0]) + "π" + (n[1] > 1 ? "/" + n[1] : "");
  };

  let points = [], hide = () => {};
  const draw = () => {
    menu();
    hide();
    const curves = rowsAt(state.fixed, state.x, state.hue);
    const number = typeof table[state.x][0] === "number", flags = known[state.y]?.flags;
    const at = (row) => (number ? table[state.x][row] : dim[state.x] ? index(dim[state.x], row) : [...new Set(table[state.x])].indexOf(table[state.x][row]));
    const up = (row) => (flags ? (flags.indexOf(table[state.y][row]) + 1 || NaN) - 1 : table[state.y][row]);
    const rows = curves.flat(), xs = rows.map(at), ys = rows.map(up).filter(Number.isFinite);
    const width = Math.max(stage.clientWidth, 280), height = Math.min(420, Math.max(260, width * 0.55));
    const margin = { left: flags ? 96 : 62, right: 24, top: 12, bottom: 34 };
    const least = ys.reduce((a, b) => Math.min(a, b), Infinity), most = ys.reduce((a, b) => Math.max(a, b), -Infinity);
    if (!ys.length) return (stage.querySelector("svg")?.remove(), (points = []), (legend.innerHTML = "no values here"));
    const logX = number && dim[state.x]?.log, logY = !flags && least > 0 && (known[state.y]?.log || most / least > 200);
    const pad = flags ? 0.5 : (most - least) * 0.05 || Math.abs(most) * 0.05 || 1;
    const yEnds = logY ? [least * 0.9, most * 1.1] : [least - pad, most + pad];
    const xs0 = xs.reduce((a, b) => Math.min(a, b), Infinity), xs1 = xs.reduce((a, b) => Math.max(a, b), -Infinity);
    const xEnds = number ? (xs1 > xs0 ? [xs0, xs1] : [xs0, xs0 + 1]) : [-0.5, xs1 + 0.5];
    const X = (v) => margin.left + share(v, xEnds, logX) * (width - margin.left - margin.right);
    const Y = (v) => height - margin.bottom - share(v, yEnds, logY) * (height - margin.top - margin.bottom);
    const parts = [];
    const upTicks = flags ? flags.map((_, i) => i).filter((i) => i >= yEnds[0] && i <= yEnds[1]) : ticks(...yEnds, logY, false, height / 55);
    const acrossTicks = number ? ticks(...xEnds, logX, known[state.x].rad, width / 80) : [...Array(Math.round(xEnds[1] + 0.5)).keys()];
    const names = number ? null : dim[state.x]?.words ?? [...new Set(table[state.x])];
    for (const v of upTicks) parts.push(`<line class="grid" x1="${margin.left}" x2="${width - margin.right}" y1="${Y(v)}" y2="${Y(v)}"/><text x="${margin.left - 7}" y="${Y(v) + 4}" text-anchor="end">${escaped(flags ? flags[v].replaceAll("_", " ") : short(v))}</text>`);
    for (const v of acrossTicks) parts.push(`<line class="grid" x1="${X(v)}" x2="${X(v)}" y1="${margin.top}" y2="${height - margin.bottom}"/><text x="${X(v)}" y="${height - margin.bottom + 18}" text-anchor="middle">${escaped(number ? (known[state.x].rad ? inPi(v) : short(v)) : String(names[v]).replaceAll("_", " "))}</text>`);
    points = [];
    curves.forEach((own, k) => {
      let path = "", open = false;
      for (const row of own) {
        const v = up(row), good = Number.isFinite(v);
        if (good) points.push({ row, left: X(at(row)) / width, top: Y(v) / height });
        if (good && sampled) parts.push(`<circle class="c${k % 7}" cx="${X(at(row)).toFixed(1)}" cy="${Y(v).toFixed(1)}" r="2"/>`);
        else if (good) path += `${open ? "L" : "M"}${X(at(row)).toFixed(1)} ${Y(v).toFixed(1)}`;
        open = good;
      }
      if (!sampled) parts.push(`<path class="c${k % 7} d${Math.floor(k / 7)}" d="${path}"/>`);
    });
    stage.querySelector("svg")?.remove();
    stage.insertAdjacentHTML("afterbegin", `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${escaped(plain(symbol(state.y)))} over ${escaped(plain(symbol(state.x)))}">${parts.join("")}</svg>`);
    room.querySelector(".up").innerHTML = label(state.y);
    room.querySelector(".across").innerHTML = label(state.x);
    legend.innerHTML = state.hue ? `<b>${label(state.hue)}</b>` + curves.map((own, k) => `<span><svg width="26" height="8"><path class="c${k % 7} d${Math.floor(k / 7)}" d="M0 4H26"/></svg>${words(state.hue, own[0])}</span>`).join("") : "";
  };
  hide = attach(stage, () => points, () => state.y);
  draw();
  let wide = stage.clientWidth;
  addEventListener("resize", () => stage.clientWidth !== wide && ((wide = stage.clientWidth), draw()));
})();
