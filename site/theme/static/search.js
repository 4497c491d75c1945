/* The search: MiniSearch over the entries of search_index.js. Both files are loaded on first use. */
(function () {
  "use strict";
  const SMALL = new Set(
    ("a about an and any are as at be been by could covers did do does doing each for from get given gets got had " +
      "happen happens has have here how i if in into is it its kind just look made make many may me mean meaning means much must my need needs of " +
      "on one or our out shall should so tell than that the their them then there these they thing this " +
      "those through to want was way we were what when where which who whose why will with work works would you your").split(" "),
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
    "Messages",
    "Paper",
    "Tests",
    "Source",
  ];
  const NAMES = new Set([...GROUPS.slice(0, 5), "Methods", "Data types", "Safety case", "Checks", "Messages"]);
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
    Messages: 0.5,
    Paper: 0.4,
    Tests: 0.15,
    Source: 0.3,
  };
  const DEFINES = /\b(mean|means|meaning|definition|glossary|term)\b|^what (is|are) (an? )?[\w-]+( here)?\??$/i; // asks for the glossary
  const ASPECTS = new Set(["class", "code", "diagram", "module", "source", "test", "uml", "unit"]); // of a module
  const DEFINITION = new Set(["glossary", "definition", "term"]);
  const GENERAL = new Set(["robot", "firmware", "software", "project"]); // an answer may lack these words of a question
  const CAN = /^Can (?=[a-z]|I\b)/; // at the beginning of a title: no CAN bus
  const MAY = /^can (?=(i|you|we|it|this|the|a)\b)/i;
  const IDS = new Set(["Requirements", "Safety case"]); // their titles are ids
  const LAST = new Set(["Tests", "Source"]); // shown first only for their own names, or when nothing else is found
  const MEANT = 2; // weight of an entry with all words of the query in its title and in the words that readers type for it
  const BEHIND = 0.1; // weight of these for two or more words
  const PHRASE = 2; // the query is a phrase that names the entry in site/search_words.txt
  const QUOTED = 4; // least number of words of a quoted message, in their sequence
  const NAME = 1; // the query is the name of the entry
  const DEFINED = 4; // weight of a term for such a question
  const WHICH = /\bwhich (requirement|class|module|method)s?\b/i; // asks for an element of a kind
  const KINDS = { requirement: "Requirements", class: "Modules", module: "Modules", method: "Methods" };
  const ASKED = 3; // weight of the elements of this kind
  const ENOUGH = 8; // number of hits with all words; with fewer hits, hits without one word are also shown
  const NEAR = 0.45; // least score of a question with two words, as a share of the best score
  const IDENTIFIER = /\b(?:FR|NFR|SG|HZ|AU)[- ]?\d+\b/gi; // ids of requirements, goals, hazards, assumptions
  const NUMBERED = /\breq(?:uirement)?\b\D{0,9}(\d+)/i; // requirement 15 is FR-15
  const UNNAMED = 0.2; // weight of an id whose number is in the query without its kind: "every 1 ms" does not ask for FR-1
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
  const large = (words) => words.filter((word) => !SMALL.has(word));
  /* "Pool of control systems" names ControlSystemPool. */
  const sorted = (text) => large(pieces(text)).map(stem).sort().join(" ");
  /* A title is also found by its words written as one: wheelcontroller, quickstart. */
  const indexed = (text, field) =>
    field === "title"
      ? [...new Set([...pieces(text), same(text), same(text.split("::").pop())])]
      : pieces(text);
  /* Requirements is requirement, crashes is crash, verified is verify. */
  function stem(word) {
    if (word.length > FEW && /ie[ds]$/.test(word)) return `${word.slice(0, -3)}y`;
    if (/(?:sh|ch|ss|x|z)es$/.test(word)) return word.slice(0, -2);
    return word.length > FEW && /[^su]s$/.test(word) ? word.slice(0, -1) : word;
  }

  let index = null;
  /* Of each entry: the stems of its title and of the words that readers type for it, and the words of its title in
     the sequence of the alphabet. */
  let known = [];
  let sortedTitles = [];
  let phrases = []; // of each entry: the phrases that name it, in the same sequence
  const { entries, synonyms } = window.PORTAL_SEARCH;
  function prepare() {
    if (index) return;
    index = new MiniSearch({
      fields: ["title", "text", "words", "also"],
      tokenize: indexed,
      processTerm: stem,
    });
    known = entries.map(([group, , title, , , , also]) => new Set(also || group === ANSWERS ? pieces(`${title.replace(CAN, "")} ${also}`).map(stem) : []));
    sortedTitles = entries.map(([group, , title]) => (NAMES.has(group) && group !== "Data types" ? sorted(title) : ""));
    phrases = entries.map(([, , , , , , also]) => (also.includes(",") ? also.split(",").map(sorted) : []));
    index.addAll(
      entries.map(([group, , title, text, , words, also], id) => {
        return { id, title: title.replace(CAN, ""), text, words, also };
      }),
    );
  }

  /* The words of a text, terms of several words (safe state) combined, each with its synonyms.
     Words are lists of their stems. */
  const groups = synonyms.map((group) =>
    group.map((words) => large(pieces(words)).map(stem)),
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
  /* The words in which two neighbouring letters are exchanged. */
  const exchanged = (word) =>
    [...word].slice(1).map((letter, i) => word.slice(0, i) + letter + word[i] + word.slice(i + 2));
  /* A word that no entry contains is replaced by the most frequent word with the least number of errors. */
  function corrected(typed) {
    const word = stem(typed);
    const { fuzzy } = tolerance(word);
    if (!fuzzy || groups.flat().some((words) => words.includes(word))) return typed;
    const right = exchanged(word).find((one) => index.search(one, { prefix: false, fuzzy: false }).length);
    if (right) return right;
    const counts = new Map();
    for (const { terms } of index.search(word, { prefix: false, fuzzy }))
      for (const term of terms) counts.set(term, (counts.get(term) || 0) + 1);
    return [...counts].sort((a, b) => b[1] - a[1])[0]?.[0] ?? typed;
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

  /* Returns whether a query quotes a message: most of its words are words of the message, in their sequence. Others are values. */
  function isQuoted(message, query) {
    let lengths = message.map(() => 0); // of the longest common sequence that ends at or before each word
    for (const word of query) {
      let before = 0;
      const next = [];
      message.forEach((own, i) => {
        next.push(Math.max(lengths[i], next[i - 1] || 0, own === word ? before + 1 : 0));
        before = lengths[i];
      });
      lengths = next;
    }
    const most = lengths[lengths.length - 1];
    return (most >= QUOTED && most > query.length / 2) || (most === query.length && most >= QUOTED - 1);
  }

  /* Returns the numbers of the entries that match a text, the best match first. */
  function find(text) {
    prepare();
    const all = pieces(text.replace(MAY, "")).map(corrected); // "can I": the CAN bus is not meant
    const isSentence = large(all).length < all.length;
    const isDefinition = DEFINES.test(text);
    const typed = large(all).filter((word, _, { length }) => !isDefinition || length === 1 || !DEFINITION.has(word));
    const words = (typed.length ? typed : all).map(stem);
    if (!words.length) return [];
    const wanted = meanings(words);
    const numbered = text.match(NUMBERED);
    const identifiers = [...(text.match(IDENTIFIER) || []).map(same), ...(numbered ? [`fr${numbered[1]}`] : [])];
    const whole = all.join("");
    const kind = KINDS[(text.match(WHICH) || [])[1]?.toLowerCase()];
    const weight = (group) => (group === "Glossary" && isDefinition ? DEFINED : (WEIGHTS[group] || 1) * (group === kind ? ASKED : 1));
    const options = {
      tokenize: pieces,
      prefix: (term) => term.length > 1 || words.length === 1,
      boost: { title: 6, also: 5, text: 2, words: 1 },
      boostDocument: (id) => weight(entries[id][0]),
    };
    /* Returns how strongly the query names an entry: by its title, or by the name of a method without its class.
       A method name of one word, such as release, is also an ordinary word. The paper's names come later. */
    const alphabetic = [...words].sort().join(" ");
    const element = words.some((word) => ASPECTS.has(word)) && words.filter((word) => !ASPECTS.has(word)).sort().join(" ");
    const named = ([group, , title], id) => {
      if (phrases[id].includes(alphabetic)) return PHRASE;
      if (group === "Modules" && element && element === sortedTitles[id]) return NAME;
      if (group === "Messages") return isQuoted(pieces(title), all) ? NAME : 0;
      const method = title.split("::").pop();
      const names = pieces(method).length > 1 ? [title, method] : [title];
      const isNamed = names.some((name) => same(name) === whole || identifiers.includes(same(name)));
      return group !== "Paper" && (isNamed || (words.length > 1 && alphabetic === sortedTitles[id])) ? NAME : 0;
    };
    /* Finds a name that is written as one word with an error. */
    const joined = { queries: [whole], prefix: false, boost: { title: 12, also: 10 }, ...tolerance(whole) };
    const ownNames = identifiers.map((own) => ({ queries: [own], prefix: false, fuzzy: false }));
    const queries = [...wanted.map(asked), ...ownNames, ...(words.length > 1 ? [joined] : [])];
    const found = index.search({ combineWith: "OR", queries }, options).map((hit) => {
      const terms = new Set(hit.queryTerms);
      const share = terms.has(stem(whole)) ? wanted.length : wanted.filter((one) => has(terms, one)).length;
      const [group] = entries[hit.id];
      const exact = named(entries[hit.id], hit.id);
      const isLast = LAST.has(group) && !exact && wanted.length > 1;
      const isMeant = words.length > 1 && words.every((word) => known[hit.id].has(word));
      const isNumber = IDS.has(group) && !exact && pieces(entries[hit.id][2]).some((part) => /^\d/.test(part) && terms.has(part));
      const weights = (isMeant ? MEANT : 1) * (isLast ? BEHIND : 1) * (isNumber ? UNNAMED : 1);
      const score = hit.score * (share / wanted.length) ** 3 * weights;
      return { id: hit.id, terms: hit.terms, score, isMeant, share: isLast ? share - 1 : share, exact, wanted, isSentence };
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
   * missing. With exactly two words, or one missing of three, the score must also be near the best score. */
  function asks({ id, wanted, score, isSentence }, near) {
    const [group, , title, , , , also] = entries[id];
    if (group !== ANSWERS) return false;
    const terms = pieces(`${title.replace(CAN, "")} ${also}`).map(stem);
    const said = (word) => terms.some((term) => term.startsWith(word));
    const has = (word) => terms.includes(word);
    const special = wanted.filter(({ own }) => !own.every((word) => GENERAL.has(word)));
    const needed = special.length ? special : wanted;
    const found = needed.filter(({ own, others }) => own.every(said) || others.some((words) => words.every(has)));
    const words = wanted.flatMap(({ own }) => own);
    const isNear = words.length > 1 ? isSentence || words.length > 2 || score >= near : isSentence && score >= near;
    const spare = needed.length > 3 || (needed.length === 3 && isSentence && score >= near) ? 1 : 0;
    return isNear && found.length >= needed.length - spare;
  }

  /* Returns the hits in groups, the group of the best hit first. */
  function grouped(text) {
    const groups = new Map();
    const written = new Set();
    const hits = find(text);
    /* A hand-written page is an entry with its words. */
    hits.forEach(({ id }) => entries[id][0] === "Explanations" && written.add(entries[id][4]));
    const isName = hits.some((hit) => hit.exact === PHRASE || (hit.exact && NAMES.has(entries[hit.id][0])));
    const near = NEAR * Math.max(...hits.map((hit) => hit.score));
    const asked = isName ? [] : hits.filter((hit) => asks(hit, near));
    const isMeant = (found) => found.some((hit) => hit.isMeant);
    if (isMeant(asked) || !isMeant(hits)) asked.length && groups.set(ANSWERS, asked);
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
