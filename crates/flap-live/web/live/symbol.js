// @ts-check
// Symbols of parameters: letters with subscripts, and Greek letters, which are given by name.

import { element } from "../shared/dom.js";

/** @type {Record<string, string>} */
const GREEK = {
  alpha: "α",
  beta: "β",
  gamma: "γ",
  delta: "δ",
  epsilon: "ε",
  eps: "ε",
  zeta: "ζ",
  eta: "η",
  theta: "θ",
  kappa: "κ",
  lambda: "λ",
  mu: "μ",
  nu: "ν",
  xi: "ξ",
  rho: "ρ",
  sigma: "σ",
  tau: "τ",
  phi: "φ",
  chi: "χ",
  psi: "ψ",
  omega: "ω",
  Gamma: "Γ",
  Delta: "Δ",
  Theta: "Θ",
  Lambda: "Λ",
  Xi: "Ξ",
  Sigma: "Σ",
  Phi: "Φ",
  Psi: "Ψ",
  Omega: "Ω",
};

/** The parts of a symbol such as `kappa_wh`. A subscript ends where another letter, an operator or a space begins. */
export const symbolParts = (/** @type {string} */ text) =>
  text
    .split(/_(\{[^}]*\}|[A-Za-z0-9,+-]+)/)
    .map((part, i) => ({ text: part, isSubscript: i % 2 === 1 }))
    .filter((part) => part.text !== "")
    .map(({ text: part, isSubscript }) => {
      const plain = isSubscript ? part.replace(/[{}]/g, "") : part;
      const greek = plain.replace(/[A-Za-z]+/g, (word) => GREEK[word] ?? word);
      return { text: isSubscript ? greek : greek.replace(/\^2/g, "²").replace(/\^3/g, "³"), isSubscript };
    });

/** A symbol as an element. */
export const symbolElement = (/** @type {string} */ text) => {
  const parts = symbolParts(text).map((part) => (part.isSubscript ? element("sub", {}, part.text) : part.text));
  return element("span", { class: "symbol", title: text }, ...parts);
};
