// The page's data, and what all parts of it use. World z up, metres.

const data = JSON.parse(document.getElementById('data').textContent);
const $ = (id) => document.getElementById(id);

// An element of a tag with properties ({className: 'x', onclick: f}) and children, which are elements or texts.
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

const with_minus = (text) => text.replace('-', '−');

// A number with at most three significant digits, 1 only from 1 on; a dash for a missing one.
function short(value) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  if (size >= 1e6) return tick_text(Number(value.toPrecision(3)));
  if (size >= 100) return with_minus(String(Math.round(value)));
  if (size > 0 && size < 1e-3) return value < 0 ? '> −0.001' : '< 0.001';
  if (size >= 0.9995 && size < 1) return value < 0 ? '< −0.999' : '> 0.999';
  return with_minus(String(Number(value.toPrecision(size < 0.995 ? 2 : 3))));  // two digits of 0.996 would be a 1
}

// A tick label of an axis: the number is round already.
function tick_text(value) {
  const size = Math.abs(value);
  if (size >= 1e6) return with_minus(`${Number((value / 1e6).toPrecision(6))} M`);
  return with_minus(size > 0 && size < 1e-3 ? value.toExponential() : String(value));
}

const with_unit = (text, unit) => unit ? `${text} ${unit}` : text;

// Whose motion it is: the name and the look of its lines. Colours stand in the style sheet (--input …); they are
// those of Okabe and Ito, which colour-blind people tell apart, and every line has its own dashes, too. What is of no
// motion has colours of its own (--line-0 …).
const people = {
  input: {name: 'input', dash: '5 3'},
  reference: {name: 'prepared reference', dash: '1.5 2.5'},
  cleaned: {name: 'cleaned', dash: ''},
  truth: {name: 'truth', dash: '8 3 2 3'},
};
const other_dashes = ['', '6 3', '2 2.5', '9 3 2 3', '4 2 1 2', '12 4', '1 3'];

const style_value = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const colour_of = (who, index) => who ? `var(--${who})` : `var(--line-${index % other_dashes.length})`;

// "#d55e00" as [213, 94, 0]
const rgb_of = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

// Whole numbers in base64 digits, the highest first. The i-th number of a group of `sizes.length` has sizes[i]
// digits; 2^(6 digits − 1) stands for 0.
const digit_values = new Uint8Array(128);
[...'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'].forEach((c, i) => { digit_values[c.charCodeAt(0)] = i; });

function decode_numbers(text, sizes) {
  const group = sizes.reduce((a, b) => a + b, 0), groups = text.length / group, numbers = new Int32Array(groups * sizes.length);
  let at = 0, n = 0;
  for (let k = 0; k < groups; ++k) {
    for (const size of sizes) {
      let value = 0;
      for (let d = 0; d < size; ++d) value = 64 * value + digit_values[text.charCodeAt(at++)];
      numbers[n++] = value - 2 ** (6 * size - 1);
    }
  }
  return numbers;
}

// Numbers that are never negative, all of one size.
const decode_counts = (text, size) => decode_numbers(text, [size]).map((n) => n + 2 ** (6 * size - 1));

// The same, one after the other.
function reader_of(text) {
  let at = 0;
  const read = (size) => decode_numbers(text.slice(at, at += size), [size])[0];
  return {number: read, count: (size) => read(size) + 2 ** (6 * size - 1)};
}
