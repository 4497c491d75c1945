/* The search: MiniSearch over the entries that portal.js has. */
(function () {
  "use strict";
  const SMALL = new Set(
    ("a an and are as at be by can do does for from has have how i if in into is it its may me must my " +
      "of on one or out so than that the then there these they this to was what when where which who why " +
      "will with you").split(" "),
  );
  /* Of equal hits, the one of the earlier group is first. */
  const GROUPS = [
    "Modules",
    "Logic modules",
    "Pattern applications",
    "Requirements",
    "Pages",
    "Explanations",
    "Methods",
    "Data types",
    "Safety case",
    "Glossary",
    "Likely changes",
    "Checks",
    "Paper",
    "Tests",
    "Source",
  ];
  const WEIGHTS = {
    Modules: 1.6,
    Pages: 1.5,
    "Logic modules": 1.2,
    Methods: 0.9,
    "Likely changes": 0.5,
    Checks: 0.5,
    Paper: 0.4,
    Tests: 0.35,
    Source: 0.5,
  };
  const FEW = 3; // letters that a word has at least before it may have a typing error

  /* WheelController is wheel and controller; FR-15, FR15 and fr 15 are fr and 15. */
  const pieces = (text) =>
    text
      .normalize("NFKD")
      .replace(/\p{M}/gu, "")
      .replace(/(\p{Ll})(\p{Lu})|(\p{Lu})(?=\p{Lu}\p{Ll})|(\p{L})(?=\p{N})|(\p{N})(?=\p{Lu})/gu, "$1$3$4$5 $2")
      .toLowerCase()
      .split(/[^\p{L}\p{N}]+/u)
      .filter(Boolean);
  const same = (text) => pieces(text).join("");
  /* A title is also found by its words written as one: wheelcontroller, quickstart. */
  const indexed = (text, field) =>
    field === "title" ? [...pieces(text), same(text)] : pieces(text);
  /* Requirements is requirement; small words are left out. */
  function stem(word) {
    if (SMALL.has(word)) return null;
    return word.length > FEW && /[^su]s$/.test(word) ? word.slice(0, -1) : word;
  }

  let index = null;
  const entries = () => (window.PORTAL ? window.PORTAL.entries : []);
  function prepare() {
    if (index) return;
    index = new MiniSearch({
      fields: ["title", "text", "words"],
      tokenize: indexed,
      processTerm: stem,
    });
    index.addAll(
      entries().map(([, , title, text, , words], id) => ({ id, title, text, words: words || "" })),
    );
  }

  /* A word, or one that means the same. */
  function meaning(word) {
    const others = ((window.PORTAL || {}).synonyms || [])
      .filter((group) => group.includes(word))
      .flatMap((group) => group.filter((other) => other !== word));
    return { combineWith: "OR", queries: [word, ...others.map(exactly)] };
  }
  const exactly = (word) => ({
    queries: pieces(word),
    combineWith: "AND",
    prefix: false,
    fuzzy: false,
    boost: { title: 5, text: 1, words: 0.3 },
  });

  /* The numbers of the entries that fit a text, the best first. */
  function find(text) {
    prepare();
    const words = pieces(text).filter((word) => !SMALL.has(word));
    if (!words.length) return [];
    const whole = same(text);
    const options = {
      tokenize: pieces,
      prefix: (term) => term.length > 1 || words.length === 1,
      fuzzy: (term) => (term.length > FEW && !/\d/.test(term) ? 0.2 : false),
      maxFuzzy: 2,
      weights: { fuzzy: 0.25, prefix: 0.6 },
      boost: { title: 6, text: 2, words: 1 },
      boostDocument: (id) => WEIGHTS[entries()[id][0]] || 1,
    };
    const asked = (combineWith) =>
      index.search({ combineWith, queries: words.map(meaning) }, options);
    const every = asked("AND");
    const found = every.length ? every : asked("OR");
    const place = (id) => GROUPS.indexOf(entries()[id][0]);
    /* Its title, or the name of the method without its class. The paper's names come later. */
    const named = ([group, , title]) =>
      group !== "Paper" && [title, title.split("::").pop()].some((name) => same(name) === whole);
    return found
      .map(({ id, score, terms }) => ({ id, terms, score, exact: named(entries()[id]) }))
      .sort((a, b) => b.exact - a.exact || (a.exact && place(a.id) - place(b.id)) || b.score - a.score);
  }

  /* The hits in groups: the group of the best hit first. */
  function grouped(text) {
    const groups = new Map();
    const seen = new Set();
    for (const hit of find(text)) {
      const [name, , , , address] = entries()[hit.id];
      if (seen.has(address) && name === "Pages") continue; // a written page is there with its words
      seen.add(address);
      if (!groups.has(name)) groups.set(name, []);
      groups.get(name).push(hit);
    }
    return groups;
  }

  window.PortalSearch = { prepare, grouped, pieces };
})();
