// The ranking of the search: pages for users first, pages for contributors and listings of files last.
var Scorer = {
  score: ([docname, , , , score]) => {
    if (docname.startsWith("contributing/") || docname.startsWith("files/")) return score - 12;
    if (docname.startsWith("evidence/") || docname.startsWith("models/methods")) return score - 4;
    return score;
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
