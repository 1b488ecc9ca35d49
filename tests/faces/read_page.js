// Run the script of a report in Node.js with a stand-in for the browser, and print what it shows, as JSON.
const html = require("fs").readFileSync(process.argv[2], "utf8");
const about = html.match(/<script type="application\/json" id="about">([\s\S]*?)<\/script>/)[1];
const script = [...html.matchAll(/<script>([\s\S]*?)<\/script>/g)].at(-1)[1];
const href = html.match(/href="(data:application\/gzip;base64,[^"]*)"/)[1].replaceAll("&#43;", "+");
const element = () => ({
  children: [], style: {}, className: "", hidden: false, clientWidth: 800, listeners: {}, textContent: "", parts: {},
  set innerHTML(words) { this.textContent = words.replace(/<br>/g, "; ").replace(/<[^>]*>/g, ""); },
  setAttribute() {}, remove() {},
  append(...more) { this.children.push(...more); },
  add(more) { this.children.push(more); },
  replaceChildren() { this.children = []; },
  addEventListener(name, act) { this.listeners[name] = act; },
  getBoundingClientRect: () => ({ left: 0, top: 0, width: 1000, height: 1000 }),
  querySelector(query) { return query === "svg" ? null : (this.parts[query] ??= element()); },
  insertAdjacentHTML(_, svg) { this.svg = svg; },
});
const elements = { about: { textContent: about }, table: { href, download: "x.csv.gz" }, plot: element(), slice: element() };
global.document = { getElementById: (id) => elements[id] ?? null, createElement: element, querySelectorAll: () => [] };
global.Option = function (words) { this.text = words; };
global.addEventListener = () => {};
URL.createObjectURL = () => "blob:";
eval(script);
setTimeout(() => {
  const card = elements.plot.children[1], hovered = new Set();
  const [controls, stage] = [".controls", ".stage"].map((name) => elements.slice.querySelector(name));
  for (let i = 0; i < 100; i++)
    for (let j = 0; j < 100; j++) {
      elements.plot.listeners.pointermove({ clientX: 10 * i, clientY: 10 * j });
      if (!card.hidden) hovered.add(card.textContent);
    }
  const choices = controls.children.map((label) => label.children[0].children.map((option) => option.text));
  console.log(JSON.stringify({ hovered: [...hovered], choices, drawn: stage.svg?.length ?? 0 }));
}, 300);
