// The rows in the page as columns: numbers, or codes with their words. A column is decoded when it is first needed.

const results = JSON.parse(byId("data").textContent);
const TYPES = { f64: Float64Array, f32: Float32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array };

const bytesOf = (text) => {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text).buffer;
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes.buffer;
};

/** A column with its cells: numbers by row, NaN for none; of words, their codes. */
const columnOf = (column) => {
  let cells = null, extent = null;
  return {
    ...column,
    words: column.words ?? null,
    /** The least and the largest value; null if there is none. */
    get extent() { return (extent ??= [extentOf(this.cells)])[0]; },
    get cells() {
      if (cells) return cells;
      const raw = new TYPES[column.type](bytesOf(column.data));
      cells = raw;
      if (column.values) cells = Float64Array.from(raw, (code) => column.values[code] ?? NaN);
      if (column.words) cells = Float64Array.from(raw, (code) => (code < column.words.length ? code : NaN));
      return cells;
    },
  };
};
const columns = results.columns.map(columnOf);
const placeOf = new Map(columns.map((column, place) => [column.name, place]));
const statusPlace = placeOf.get("status");
const numberPlaces = columns.map((_, place) => place).filter((place) => !columns[place].words);

/** A cell as it is shown, with the unit of the page. */
const shownCell = (column, row) => {
  const value = column.cells[row];
  if (column.words) return Number.isNaN(value) ? "none" : column.words[value];
  return shortNumber(value * column.factor);
};

/** A cell as a file has it: all digits that the page has, in the unit of the file. */
const exactCell = (column, row) => {
  const value = column.cells[row];
  if (Number.isNaN(value)) return "";
  if (column.words) return /[",\n]/.test(column.words[value]) ? `"${column.words[value].replaceAll('"', '""')}"` : column.words[value];
  return String(column.type === "f32" ? Number(value.toPrecision(7)) : value);
};

/** Some rows as CSV. */
const csvOf = (rows) => {
  const quoted = (name) => (/[",\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);
  const lines = [columns.map(({ name }) => quoted(name)).join(",")];
  for (const row of rows) lines.push(columns.map((column) => exactCell(column, row)).join(","));
  return lines.join("\n") + "\n";
};

/** The different values of a column, rising; undefined if there are more than a thousand. */
const levelsOf = (column, rows) => {
  const seen = new Set();
  for (let i = 0; i < (rows ? rows.length : results.rows); i++) {
    const value = column.cells[rows ? rows[i] : i];
    if (!Number.isNaN(value)) seen.add(value);
  }
  return [...seen].sort((a, b) => a - b);
};

/** The least and the largest of some numbers; null if there are none. */
const extentOf = (values) => {
  let low = Infinity, high = -Infinity;
  for (const value of values) { if (value < low) low = value; if (value > high) high = value; }
  return low <= high ? [low, high] : null;
};
