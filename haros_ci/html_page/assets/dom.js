// Elements of the page. Text of a workspace is only ever given as text, never as markup, as an attribute that loads or as an address.
const NAMESPACE = "http://www.w3.org/2000/svg";

function fill(element, properties, children) {
  for (const [name, value] of Object.entries(properties || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "href") element.setAttribute("href", "#" + String(value).replace(/^#/, ""));
    else if (name === "value") element.value = value;
    else if (name === "checked") element.checked = value;
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children.flat(9)) {
    if (child === null || child === undefined || child === false || child === "") continue;
    element.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
  return element;
}

const h = (tag, properties, ...children) => fill(document.createElement(tag), properties, children);
const s = (tag, properties, ...children) => fill(document.createElementNS(NAMESPACE, tag), properties, children);

function clear(element, ...children) {
  element.textContent = "";
  return fill(element, null, children);
}

const compare = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
const count = (number, noun) => `${number.toLocaleString("en")} ${noun}${number === 1 ? "" : "s"}`;
const cut = (text, most) => (text.length <= most ? text : `${text.slice(0, most - 1)}…`);
const last = (name) => name.slice(name.lastIndexOf("/") + 1) || name;

// A revision that is named by its whole hash is told by the beginning of it.
const revision = (words) => words.replace(/^([0-9a-f]{12})[0-9a-f]+ \(\1\)$/, "$1");

// The address of a view within the page: #view?key=value, with names percent-encoded.
function address(view, parameters) {
  const said = Object.entries(parameters || {}).filter(([, value]) => value !== "" && value !== null && value !== undefined);
  const text = said.map(([key, value]) => `${encodeURIComponent(key)}=${encodeURIComponent(value)}`).join("&");
  return view + (text ? `?${text}` : "");
}

function current() {
  const [view, text] = location.hash.slice(1).split("?", 2);
  const parameters = {};
  for (const part of (text || "").split("&")) {
    const at = part.indexOf("=");
    if (at < 1) continue;
    try {
      parameters[decodeURIComponent(part.slice(0, at))] = decodeURIComponent(part.slice(at + 1));
    } catch {
      continue; // no address that this page has made
    }
  }
  return { view, parameters };
}

// What the view that is shown does before and after it is printed.
const printing = [];
const whenPrinted = (before, after) => printing.push([before, after]);

// A long name may be broken behind its slashes, colons and underscores; what is copied of it stays the same.
function breakable(name) {
  const parts = [];
  for (const part of name.match(/[^/_:]+[/_:]*|[/_:]+/g) || []) {
    if (parts.length && /(^|\s)[/_:]+$/.test(parts[parts.length - 1])) parts[parts.length - 1] += part; // a slash at the beginning stays with its name
    else parts.push(part);
  }
  return parts.flatMap((part, at) => (at ? [h("wbr"), part] : [part]));
}

const link = (view, parameters, ...children) => h("a", { href: address(view, parameters) }, ...children);

// Change parameters of the address without a step in the history.
function remember(parameters) {
  const { view, parameters: before } = current();
  history.replaceState(null, "", `#${address(view, { ...before, ...parameters })}`);
}

// In a narrow window the details stand below what was clicked, out of sight.
function intoSight(element) {
  const detail = element.closest(".split")?.querySelector(".detail.open");
  if (detail && detail.getBoundingClientRect().top >= element.getBoundingClientRect().bottom - 1) detail.scrollIntoView({ block: "start" });
}

function later(work, milliseconds) {
  let timer = 0;
  return (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => work(...given), milliseconds);
  };
}

function chooser(label, values, chosen, change) {
  const select = h("select", { "aria-label": label, onchange: () => change(select.value) });
  for (const [value, text] of values) select.append(h("option", { value: value, selected: value === chosen }, text));
  select.value = chosen;
  return h("label", { class: "choice" }, h("span", null, label), select);
}

// Enlarge, shrink and fit a picture.
const zoomButtons = (picture) => h("span", { class: "buttons" }, h("button", { onclick: () => picture.zoom(1.3), "aria-label": "enlarge" }, "+"), h("button", { onclick: () => picture.zoom(0.77), "aria-label": "shrink" }, "−"), h("button", { onclick: () => picture.fit() }, "Fit"));

function toggle(label, checked, change) {
  const box = h("input", { type: "checkbox", checked, onchange: () => change(box.checked) });
  return h("label", { class: "toggle" }, box, label);
}

function searchField(label, value, change) {
  const input = h("input", { type: "search", class: "search", placeholder: `${label} ( / )`, "aria-label": label, value });
  input.addEventListener("input", later(() => change(input.value), 60));
  return input;
}

async function copy(text, button) {
  const before = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "Copied";
  } catch {
    const area = h("textarea", { class: "copied", readonly: true, "aria-label": "text to copy" });
    area.value = text;
    button.after(area);
    area.select();
    button.textContent = document.execCommand("copy") ? "Copied" : "Select and copy";
    if (button.textContent === "Copied") area.remove();
  }
  setTimeout(() => (button.textContent = before), 1500);
}
