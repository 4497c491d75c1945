/* The search: MiniSearch over the entries of search_index.js. Both files are loaded on first use. */
(function () {
  "use strict";
  const SMALL = new Set(
    ("a about an and any are as at be been by could did do does doing each for from get given gets got had " +
      "happen happens has have how i if in into is it its kind just look made make many may me mean meaning means much must my of " +
      "on one or our out shall should so tell than that the their them then there these they thing this " +
      "those to was way we were what when where which who whose why will with work works would you your").split(" "),
  );
  /* Among equal hits, the hit of the earlier group comes first. */
  const ANSWERS = "Answers";
  const GROUPS = [
    "Modules",
    "Logic modules",
    "Pattern applications",
    "Requirements",
    "Pages",
    ANSWERS,
    "Explanations",
    "Sections",
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
  const NAMES = new Set([...GROUPS.slice(0, 5), "Methods", "Data types", "Safety case", "Checks"]);
  const WEIGHTS = {
    Modules: 1.6,
    Pages: 1.5,
    Answers: 1.1,
    Sections: 0.7,
    "Logic modules": 1.2,
    Methods: 0.8,
    "Data types": 0.2,
    Glossary: 0.95,
    "Likely changes": 0.5,
    Checks: 0.5,
    Paper: 0.4,
    Tests: 0.15,
    Source: 0.3,
  };
  const DEFINES = /\b(mean|means|meaning|definition)\b|^what (is|are) (an? )?[\w-]+( here)?\??$/i; // asks for the glossary
  const MAY = /^can (?=(i|you|we|it|this|the|a)\b)/i;
  const DEFINED = 4; // weight of a term for such a question
  const ENOUGH = 8; // number of hits with all words; with fewer hits, hits without one word are also shown
  const NEAR = 0.45; // least score of a question with two words, as a share of the best score
  const IDENTIFIER = /\b(?:FR|NFR|SG|HZ|AU)[- ]?\d+\b/gi; // ids of requirements, goals, hazards, assumptions
  const FEW = 3; // least number of letters of a word that may contain a typing error

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
    field === "title"
      ? [...new Set([...pieces(text), same(text), same(text.split("::").pop())])]
      : pieces(text);
  /* Requirements is requirement, verified is verify. */
  function stem(word) {
    if (word.length > FEW && /ie[ds]$/.test(word)) return `${word.slice(0, -3)}y`;
    return word.length > FEW && /[^su]s$/.test(word) ? word.slice(0, -1) : word;
  }

  let index = null;
  const { entries, synonyms, aliases } = window.PORTAL_SEARCH;
  const titles = new Map(aliases.map(([query, title]) => [same(query), same(title)]));
  function prepare() {
    if (index) return;
    index = new MiniSearch({
      fields: ["title", "text", "words", "also"],
      tokenize: indexed,
      processTerm: stem,
    });
    index.addAll(
      entries.map(([group, , title, text, , words = ""], id) =>
        group === ANSWERS ? { id, title: title.replace(MAY, ""), text, words: "", also: words } : { id, title, text, words, also: "" },
      ),
    );
  }

  /* The words of a text, terms of several words (safe state) combined, each with its synonyms.
     Words are lists of their stems. */
  const groups = synonyms.map((group) =>
    group.map((words) => pieces(words).filter((word) => !SMALL.has(word)).map(stem)),
  );
  const equal = (one, other) => one.join(" ") === other.join(" ");
  function meanings(words) {
    const found = [];
    for (let i = 0; i < words.length; ) {
      const most = [3, 2, 1].find(
        (n) =>
          n === 1 || groups.some((g) => g.some((one) => equal(one, words.slice(i, i + n)) && one.length === n)),
      );
      const own = words.slice(i, i + most);
      const same = groups.filter((group) => group.some((one) => equal(one, own))).flat();
      found.push({ own, others: same.filter((one) => !equal(one, own)) });
      i += own.length;
    }
    return found;
  }
  /* Returns the options of the search for a word. A word that exists needs no tolerance, and hits inside longer words
     have little weight. Any other word is searched with the least number of errors that finds a word. */
  const kept = new Map();
  function tolerance(word) {
    if (!kept.has(word)) kept.set(word, tolerated(word));
    return kept.get(word);
  }
  function tolerated(word) {
    const there = (prefix, fuzzy) => index.search(word, { prefix, fuzzy }).length > 0;
    if (there(false, false)) return { fuzzy: false, weights: { fuzzy: 0.25, prefix: 0.15 } };
    const least = [0, 1, 2].find((n) => n === 0 ? there(true, false) : word.length > [, FEW, FEW + 2][n] && there(false, n));
    return { fuzzy: least || false, weights: { fuzzy: 0.45, prefix: 0.6 } };
  }
  const asked = ({ own, others }) => ({
    combineWith: "OR",
    queries: [
      { combineWith: "AND", queries: own.map((word) => ({ queries: [word], ...tolerance(word) })) },
      ...others.map(exactly),
    ],
  });
  const exactly = (queries) => ({
    queries,
    combineWith: "AND",
    prefix: false,
    fuzzy: false,
    boost: { title: 5, also: 4, text: 1, words: 0.3 },
  });
  const has = (terms, { own, others }) =>
    [own, ...others].some((words) => words.every((word) => terms.has(word)));

  /* Returns the numbers of the entries that match a text, the best match first. */
  function find(text) {
    prepare();
    const all = pieces(text.replace(MAY, "")); // "can I": the CAN bus is not meant
    const large = all.filter((word) => !SMALL.has(word));
    const words = (large.length ? large : all).map(stem);
    if (!words.length) return [];
    const wanted = meanings(words);
    const identifiers = (text.match(IDENTIFIER) || []).map(same);
    const isSentence = large.length < all.length;
    const whole = titles.get(same(text)) || same(text);
    const options = {
      tokenize: pieces,
      prefix: (term) => term.length > 1 || words.length === 1,
      boost: { title: 6, also: 5, text: 2, words: 1 },
      boostDocument: (id) => (entries[id][0] === "Glossary" && DEFINES.test(text) ? DEFINED : WEIGHTS[entries[id][0]] || 1),
    };
    /* Returns the title of an entry, or the name of a method without its class. A method name of one word, such as
       release, is also an ordinary word. The paper's names come later. */
    const named = ([group, , title]) => {
      const method = title.split("::").pop();
      const names = pieces(method).length > 1 ? [title, method] : [title];
      return group !== "Paper" && names.some((name) => same(name) === whole || identifiers.includes(same(name)));
    };
    /* Finds a name that is written as one word with an error. */
    const joined = { queries: [whole], prefix: false, boost: { title: 12, also: 10 }, ...tolerance(whole) };
    const ownNames = identifiers.map((own) => ({ queries: [own], prefix: false, fuzzy: false }));
    const queries = [...wanted.map(asked), ...ownNames, ...(words.length > 1 ? [joined] : [])];
    const found = index.search({ combineWith: "OR", queries }, options).map((hit) => {
      const terms = new Set(hit.queryTerms);
      const share = terms.has(stem(whole)) ? wanted.length : wanted.filter((one) => has(terms, one)).length;
      const score = hit.score * (share / wanted.length) ** 3;
      return { id: hit.id, terms: hit.terms, score, share, exact: named(entries[hit.id]), wanted, isSentence };
    });
    const most = Math.max(...found.map((hit) => hit.share));
    const best = found.filter((hit) => hit.share === most || hit.exact);
    const left = best.length < ENOUGH ? found.filter((hit) => hit.share >= Math.max(1, most - 1) || hit.exact) : best;
    const place = (id) => GROUPS.indexOf(entries[id][0]);
    return left.sort(
      (a, b) => b.exact - a.exact || (a.exact && place(a.id) - place(b.id)) || b.score - a.score,
    );
  }

  /* Returns whether a question contains the words of a text with two or more words. Of many words, one may be
   * missing. With exactly two words, the score must also be near the best score. */
  function asks({ id, wanted, score, isSentence }, near) {
    const [group, , title, , , also = ""] = entries[id];
    if (group !== ANSWERS) return false;
    const terms = pieces(`${title} ${also}`).map(stem);
    const said = (word) => terms.some((term) => term.startsWith(word));
    const found = wanted.filter(({ own, others }) => [own, ...others].some((words) => words.every(said)));
    const words = wanted.flatMap(({ own }) => own);
    const isNear = words.length > 1 ? isSentence || words.length > 2 || score >= near : isSentence && score >= near;
    return isNear && found.length >= wanted.length - (wanted.length > 3);
  }

  /* Returns the hits in groups, the group of the best hit first. */
  function grouped(text) {
    const groups = new Map();
    const written = new Set();
    const hits = find(text);
    /* A hand-written page is an entry with its words. */
    hits.forEach(({ id }) => entries[id][0] === "Explanations" && written.add(entries[id][4]));
    const isName = hits.some((hit) => hit.exact && (titles.has(same(text)) || NAMES.has(entries[hit.id][0])));
    const near = NEAR * Math.max(...hits.map((hit) => hit.score));
    const asked = isName ? [] : hits.filter((hit) => asks(hit, near));
    if (asked.length) groups.set(ANSWERS, asked);
    for (const hit of hits) {
      const [name, , , , address] = entries[hit.id];
      if (name === "Pages" && written.has(address)) continue;
      if (asked.length && name === ANSWERS) continue;
      if (!groups.has(name)) groups.set(name, []);
      groups.get(name).push(hit);
    }
    return groups;
  }

  window.PortalSearch = { prepare, grouped, pieces };
})();
