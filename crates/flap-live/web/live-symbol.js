// Symbols of parameters as they are printed: letters with subscripts, Greek ones by their names.

const GREEK = { alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ε", eps: "ε", zeta: "ζ", eta: "η", theta: "θ", kappa: "κ", lambda: "λ", mu: "μ", nu: "ν",
  xi: "ξ", rho: "ρ", sigma: "σ", tau: "τ", phi: "φ", chi: "χ", psi: "ψ", omega: "ω", Gamma: "Γ", Delta: "Δ", Theta: "Θ", Lambda: "Λ", Xi: "Ξ",
  Sigma: "Σ", Phi: "Φ", Psi: "Ψ", Omega: "Ω" };

/** A symbol such as `kappa_wh` or `I_zz`. */
const symbolOf = (text) => {
  const greek = (letters) => letters.replace(/[A-Za-z]+/g, (word) => GREEK[word] ?? word);
  const symbol = element("span", { class: "symbol", title: text });
  // A subscript ends where another letter, an operator or a space begins.
  for (const [i, part] of text.split(/_(\{[^}]*\}|[A-Za-z0-9,+-]+)/).entries()) {
    if (part === "") continue;
    symbol.append(i % 2 ? element("sub", {}, greek(part.replace(/[{}]/g, ""))) : greek(part).replace(/\^2/g, "²").replace(/\^3/g, "³"));
  }
  return symbol;
};
