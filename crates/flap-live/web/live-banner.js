// What the whole page has to say above everything else, by its reason.

const banner = { words: { server: "", address: "", error: "", far: "" } };

/** Says something, or no longer. */
banner.say = (reason, words) => {
  banner.words[reason] = words;
  const all = Object.values(banner.words).filter(Boolean);
  byId("banner").hidden = all.length === 0;
  byId("banner").textContent = all.join(" · ");
};

/** Marks a part of the page as that of an earlier design, and says so; no words: as that of this one. */
const markOld = (part, words) => {
  byId(part).classList.toggle("old", Boolean(words));
  const note = byId(part).querySelector(".old-note");
  note.hidden = !words;
  if (note.textContent !== words) note.textContent = words;
};
