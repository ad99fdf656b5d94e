// Types of the pages' data, only for the type checker and editors: no page contains this file.

import type UPlot from "uplot";
import type { Chart } from "./chart/chart.js";

export type { Chart, UPlot };

/** An axis of a chart. */
export interface Axis {
  label: string;
  unit: string;
  log: boolean;
}

export type Range = [number, number];

/** The part of the plane that a chart shows; null shows everything. */
export interface ZoomView {
  x: Range | null;
  y: Range | null;
}

/** A line. The legend switches all lines of a group; null or undefined in `y` is a gap. */
export interface Line {
  key: string;
  group?: string;
  name: string;
  color: string;
  x: number[];
  y: (number | null | undefined)[];
  /** The value of `Mark.row` for each value. */
  rows?: ArrayLike<any>;
  dash?: number[];
  width?: number;
  /** True for a line of an earlier design: it is pale, and the pointer does not mark it. */
  ghost?: boolean;
  /** True if each value has a mark. */
  marks?: boolean;
}

/** A value of x without a value of y, with the group of its line and the status of its row. */
export interface Gap {
  group: string;
  x: number;
  status: string;
  name: string;
  row: any;
  shape: string;
  color: string;
}

/** Points; colours are numbers 0xAABBGGRR. */
export interface PointSet {
  x: Float64Array;
  y: Float64Array;
  rows: ArrayLike<number>;
  colors: Uint32Array;
  size: number;
}

/** The points of a chart in pixels of the canvas, and by the squares of the canvas that contain them. */
export interface PlacedPoints {
  px: Float32Array;
  py: Float32Array;
  squares: Map<number, number[]> | null;
}

/** Cells of a map: `i` and `j` are the places of each among the edges. */
export interface CellSet {
  edgesX: number[];
  edgesY: number[];
  i: number[];
  j: number[];
  rows: number[];
  colors: number[];
  byPlace?: Map<number, number>;
}

/** The shades of a chart, from the colour of `low` to the colour of `high`. */
export interface ColourBar {
  label: string;
  unit: string;
  low: number;
  high: number;
  log: boolean;
}

/** An entry of the legend with the shape of a status. */
export interface StatusEntry {
  name: string;
  color: string;
  shape: string;
}

/** The contents of a chart. */
export interface Scene {
  x: Axis;
  y: Axis;
  lines: Line[];
  points?: PointSet;
  cells?: CellSet;
  /** The ranges of points or cells. */
  extent?: { x: Range; y: Range };
  /** The quantity by which the lines differ. */
  title?: string;
  /** Colours of points and cells. */
  legend?: { name: string; color: string }[];
  bar?: ColourBar | null;
  statuses?: StatusEntry[];
  gaps?: Gap[];
  /** Shaded ranges of x. */
  bands?: { from: number; to: number }[];
  /** A ring. */
  marker?: { x: number; y: number } | null;
}

/** A place of a chart that the pointer or the keyboard has selected. */
export interface Mark {
  /** The key of the line; "point", "cell" or "gap". */
  key: string;
  name: string;
  /** The place in the line or set; the status of a gap. */
  index: number | string;
  row: any;
  x: number;
  y: number | null;
  /** All gaps at the x of a gap. */
  gaps?: Gap[];
}

export interface ChartOptions {
  /** The name for screen readers. */
  name?: string;
  height?: number;
  onPoint?(mark: Mark | null): void;
  onPin?(mark: Mark | null): void;
  onSelect?(rows: any[]): void;
  onView?(view: ZoomView): void;
  onHidden?(groups: string[]): void;
  /** Draws the scene again after the colours of the scheme have changed. */
  onScheme?(): void;
}

/** An entry of the legend in a picture: swatches of colours, or the shape of a status. */
export interface PictureEntry {
  name: string;
  colors?: string[];
  color?: string;
  shape?: string;
}

/** An entry of the legend in a picture with its place: pixels from the left, and its row. */
export interface PlacedEntry {
  entry: PictureEntry;
  left: number;
  row: number;
  words: number;
}

/** A tick of an axis. */
export interface Tick {
  value: number;
  label: string;
}

/** The parameters of a design that differ from the opened design. Null removes a value. */
export type Design = Record<string, number | string | null>;

export interface Parameter {
  name: string;
  label: string;
  group: string;
  symbol: string;
  doc: string;
  allowed: string;
  unit: string;
  factor: number;
  kind: "number" | "choice" | "following" | "derived";
  options: string[] | null;
  value: number | string | null;
  /** The value of the preset or of [vehicle]. */
  published: number | string | null;
  low: number;
  high: number;
  log: boolean;
  /** The limits of allowed values; null if there are not two. */
  limits: Range | null;
  whole: boolean;
  fitted: boolean;
}

export interface Measure {
  name: string;
  label: string;
  unit: string;
  doc: string;
}

/** The data of the live page, written by the server. */
export interface OpenedDesign {
  version: string;
  title: string;
  preset: string;
  model: string;
  doc: string;
  parameters: Parameter[];
  measures: Measure[];
  view: { x: AxisRange; by: LineValues | null; measure: string };
  can: { motion: boolean };
}

/** The parameter along x, with its range in SI units. */
export interface AxisRange {
  name: string;
  from: number;
  to: number;
}

/** The parameter with a line for each of its values. */
export interface LineValues {
  name: string;
  values: (number | string)[];
}

export interface LiveState {
  design: Design;
  x: AxisRange;
  by: LineValues | null;
  measure: string;
  log: { x: boolean; y: boolean };
  view: ZoomView;
  /** True if the responses up and down are shown instead of the family. */
  updown: boolean;
  /** Groups of lines that the legend has switched off. */
  hidden: string[];
  pins: { name: string; design: Design }[];
}

/** Rows of the server, by columns. */
export interface RowTable {
  columns: string[];
  rows: any[][];
}

/** Rows of the server with their request. */
export interface ResponseAnswer extends RowTable {
  kind: "family" | "hysteresis";
  request: { design: Design; x: AxisRange & { n: number }; by?: LineValues | null };
  /** The state at the beginning of each row's motion, for responses up and down. */
  states?: number[][];
}

/** The row behind a value of a response line. */
export interface ResponseRow {
  status: string;
  stable: boolean | null;
  bistable: boolean;
  /** The parameter along x, in SI units. */
  x: number;
  by: number | string | null;
  /** The state at the beginning of the motion; null if the motion settles from rest. */
  begin: number[] | null;
}

/** A line of a response, before it has a colour. */
export interface ResponseLine extends Omit<Line, "color"> {
  rows: ResponseRow[];
  place: number;
  of: number;
  color?: string;
}

/** A gap of a response, before it has a mark. */
export interface ResponseGap extends Omit<Gap, "shape" | "color"> {}

/** The numbers of a design, from the server. */
export interface PointAnswer {
  columns: string[];
  row: any[];
  /** The value of each parameter: SI units, or an option. */
  values: Design;
  published: any[];
  reason: string | null;
  warnings: string[];
  modes: { name: string; frequency_hz: number }[] | null;
  published_modes: { name: string; frequency_hz: number }[] | null;
  gradient: { parameter: string; per_percent: number }[] | null;
  gradient_reason: string | null;
}

/** The outline of a wing: metres, and the chord at shares 0 to 1 of the span. */
export interface WingShape {
  length: number;
  offset: number;
  axis: number;
  chord(share: number): number;
}

/** Signals of a motion by name, each with a value per sample; null for signals that the model does not have. */
export type Signals = Record<string, number[] | null>;

/** A column of a page of results, as the command writes it: cells are numbers in base64. */
export interface StoredColumn {
  name: string;
  label: string;
  unit: string;
  title: string;
  factor: number;
  type: "f64" | "f32" | "u8" | "u16" | "u32";
  data: string;
  values?: (number | null)[];
  words?: string[];
}

export type Cells = Float64Array | Float32Array | Uint8Array | Uint16Array | Uint32Array;

/** A column of a page of results: numbers by row, NaN for none; a column of words has their codes. */
export interface Column extends Omit<StoredColumn, "words"> {
  words: string[] | null;
  readonly cells: Cells;
  /** The smallest and the largest value; null if there is none. */
  readonly extent: Range | null;
}

/** The data of a page of results, as the command writes them. */
export interface ResultsData {
  columns: StoredColumn[];
  /** Places of the parameters that vary. */
  axes: number[];
  /** The place of the column `branch`; null if there is none. */
  branch: number | null;
  rows: number;
  /** Rows of the file. */
  of: number;
  stride: number;
  /** True if measures have seven digits. */
  single: boolean;
  start: {
    kind: "line" | "scatter" | "map";
    x: number;
    y: number;
    by: number | null;
    color: number | null;
    best: string;
    where: Record<string, number | string>;
  };
}

/** A view of a page of results: columns by their places. */
export interface ResultsView {
  kind: "line" | "scatter" | "map";
  x: number;
  y: number;
  by: number | null;
  color: number | null;
  /** Signs of the directions that are better, such as "1,-1"; empty for no front. */
  best: string;
  log: { x: boolean; y: boolean; color: boolean };
  zoom: ZoomView;
  hidden: string[];
}

export interface Filter {
  place: number;
  low: number;
  high: number;
}

/** Elements by their ids, where they are more than `HTMLElement`. */
export interface PageElements {
  search: HTMLInputElement;
  measure: HTMLSelectElement;
  x: HTMLSelectElement;
  y: HTMLSelectElement;
  by: HTMLSelectElement;
  color: HTMLSelectElement;
  kind: HTMLSelectElement;
  best: HTMLSelectElement;
  "x-from": HTMLInputElement;
  "x-to": HTMLInputElement;
  "by-values": HTMLInputElement;
  "log-x": HTMLInputElement;
  "log-y": HTMLInputElement;
  "log-color": HTMLInputElement;
  speed: HTMLInputElement;
  above: HTMLCanvasElement;
  "tip-view": HTMLCanvasElement;
  all: HTMLDetailsElement;
  "save-dialog": HTMLDialogElement;
}

declare global {
  interface Window {
    /** For the browser tests and the benchmarks of pages: contents of charts, which the DOM does not show. */
    flapTestHook: Record<string, any>;
  }

  interface Uint8ArrayConstructor {
    fromBase64?(text: string): Uint8Array<ArrayBuffer>;
  }

  interface Performance {
    measure(name: string, options: { start: number; end: number }): PerformanceMeasure;
  }
}
