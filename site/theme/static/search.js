/* The search. It uses MiniSearch for the entries of search_index.js, and for the phrases that readers type when they
   look for these entries. The page loads this script and MiniSearch when the reader first uses the search.
   1. MiniSearch finds the words of the index that a typed word can mean. The typed word may be only the beginning of a
      word, or contain a typing error.
   2. MiniSearch finds the phrases and the entries that contain these words.
   3. The score of an entry has three parts: the score of its best phrase, the share of the query that the entry
      contains, and the score of MiniSearch. If the query is the name of an entry, this entry is first. */
(function () {
  "use strict";
  const SMALL = new Set(
    ("a about an and any are as at be been by could did do does doing each for from get given gets got had " +
      "happen happens has have here how i if in into is it its just kind look made make may me much must my " +
      "need needs of on or our shall should so than that the their them then there these they thing this those " +
      "through to want was way we were what when where which who whose will with work works would you your").split(" "),
  );
  /* The weight of a group is less than 1 if readers seldom search for its entries. The other groups have the weight
     1. */
  const WEIGHTS = {
    "Logic modules": 0.97,
    "Pattern applications": 0.97,
    "Safety case": 0.97,
    Sections: 0.95,
    Requirements: 0.95,
    Glossary: 0.97,
    Checks: 0.95,
    Methods: 0.9,
    Messages: 0.7,
    "Data types": 0.65,
    Source: 0.55,
    "Likely changes": 0.5,
    Paper: 0.5,
    Tests: 0.4,
  };
  /* If the query contains one of these words, the reader asks for entries of the listed groups. */
  const KINDS = [
    ["requirement req test tested verify covered cover", ["Requirements", "Safety case"]],
    ["hazard goal", ["Safety case"]],
    ["class module code source implementation implemented interface", ["Modules", "Logic modules"]],
    ["method function", ["Methods"]],
    ["pattern", ["Pattern applications"]],
    ["check rule", ["Checks"]],
    ["message", ["Messages"]],
    ["mean meaning definition define glossary term", ["Glossary"]],
    ["struct enum type", ["Data types"]],
  ];
  const DEFINES = /^what (is|are) (an? |the )?[\w-]+( \w+)?\??$/i; // a query of this form asks for an entry of the glossary
  const ASKED = 1.25; // weight of a group for which the query asks (see KINDS)
  const OPTIONAL = 0.5; // weight of a word that asks for a group; it is low because many entries of the group lack it
  const ALIKE = 0.7; // weight of a synonym
  const BEGUN = 0.7; // weight of a word that begins with the typed letters
  const CORRECTED = 0.95; // weight of the most frequent word that differs from the typed word by one typing error
  const LENGTHS = [0, 4, 6]; // [n]: least number of letters that a word needs to have n typing errors
  const FEW = 3; // a word with at most this number of letters keeps its ending
  const LONG = 6; // greatest number of words of a phrase; a longer text is handled as a list of single words
  const MIDDLE = 0.7; // for a list of single words, the score uses this share instead of the covered share
  const CLOSE = 0.5; // exponent of the share of a phrase that the query covers
  const WHOLE = 3; // exponent of the share of the query that an entry contains
  const [PHRASE, WORDS, LIBRARY] = [2, 3, 0.7]; // weights of the parts of a score
  const EQUAL = 0.5; // added to the score of a phrase that is equal to the query
  const NAMED = 6; // added to the score of an entry if its name or number is in the query
  const PLACES = { title: 1, phrases: 0.9, lists: 0.75, body: 0.35 }; // weight of a word of an entry, by the field that contains the word
  const BOOST = { title: 6, phrases: 5, lists: 3, body: 1 }; // weights of the fields in the score of MiniSearch
  const COMMON = 60; // words that are in far fewer entries than this number have almost the same weight
  const QUOTED = 4; // a query that quotes a message has at least this number of its words, in the same order
  const UNNAMED = new Set(["Logic modules", "Paper", "Tests"]); // groups whose entries are not found by name, because entries of other groups have the same names
  const WRITTEN = new Set(["Data types", "Source"]); // groups whose entries are found by name only if the query has no space
  const TITLED = new Set(["Checks", "Pattern applications", "Safety case"]); // groups in which the text of an entry is a second title
  const PARTS = new Set(["Explanations", "Sections"]); // groups of sections: the phrase of a section also contains the title of its page
  const BEST = 3; // number of hits that are shown before the groups
  const LEAST = 0.3; // least score of a hit, as a share of the best score
  const MOST = 400; // greatest number of hits
  const IDENTIFIER = /\b(?:FR|NFR|SG|HZ|AU)[- ]?\d+\b/gi; // ids of requirements, goals, hazards, assumptions
  const NUMBERED = /\breq(?:uirement)?\b\D{0,9}(\d+)/i; // "requirement 15" means FR-15
  const COMPOUND = /\p{L}{2,}-\p{L}{2,}/gu;
  const CAN = /\b[Cc]an (?=[a-z]|I\b)/; // the verb in a title; it does not mean the CAN bus
  const MAY = /\bcan (?=(i|you|we|it|this|the|a)\b)/i;

  /* Returns the words of a text in small letters. WheelController becomes wheel and controller; FR-15, FR15 and fr 15
     become fr and 15; 5V becomes 5 and v. */
  const pieces = (text) =>
    text
      .normalize("NFKD")
      .replace(/\p{M}/gu, "")
      .replace(/(\p{Ll})(\p{Lu})|(\p{Lu})(?=\p{Lu}\p{Ll})|(\p{L})(?=\p{N})|(\p{N})(?=\p{L})/gu, "$1$3$4$5 $2")
      .toLowerCase()
      .split(/[^\p{L}\p{N}]+/u)
      .filter(Boolean);
  const same = (text) => pieces(text).join("");
  /* Returns the words without the words of SMALL. If all words are in SMALL (how does it work), returns all of them.
     */
  function large(words) {
    const others = words.filter((word) => !SMALL.has(word));
    return others.length ? others : words;
  }
  /* Returns a word without its ending. requirements becomes requirement, crashes becomes crash, verified becomes
     verify, stopping becomes stop, cycle and cycling become cycl, calibrate and calibration become calibr. */
  function stemmed(typed) {
    let word = typed;
    if (word.length > FEW && /ie[ds]$/.test(word)) word = `${word.slice(0, -3)}y`;
    else if (/(?:sh|ch|ss|x|z)es$/.test(word)) word = word.slice(0, -2);
    else if (word.length > FEW && /[^su]s$/.test(word)) word = word.slice(0, -1);
    if (word.length > FEW + 2) word = word.replace(/([^aeiou])(?:ing|ed)$/, "$1").replace(/([^lsz])\1$/, "$1");
    if (word.length > FEW + 1) word = word.replace(/e$/, "");
    return word.replace(/^(.{5,}?)(?:at|(?:at)?ion)$/, "$1");
  }
  /* The stem of each word is computed only once, because most words occur often. */
  const stemOf = new Map();
  const stem = (word) => stemOf.get(word) || stemOf.set(word, stemmed(word)).get(word);
  const stems = (text) => large(pieces(text)).map(stem);
  const kindWords = KINDS.map(([words, groups]) => [words.split(" ").map(stem), groups]);
  const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);
  const listIn = (map, key) => map.get(key) || map.set(key, []).get(key);

  const { entries, synonyms } = window.PORTAL_SEARCH;
  const groups = synonyms.map((group) => group.map(stems));
  const weightOf = (id) => WEIGHTS[entries[id][0]] || 1;
  /* MiniSearch gets lists of stems instead of texts, because the score of a phrase also needs its single stems. */
  const ready = { tokenize: (words) => [words].flat(), processTerm: (word) => word, stringifyField: (words) => words };
  const exactly = { prefix: false, fuzzy: false };
  let index = null; // index of the entries
  let phrases = null; // index of the phrases
  let spellings = null; // index of the whole words, without the words that have numbers
  const counts = new Map(); // word -> number of the entries that contain it
  const compounds = new Map(); // word with a hyphen, written without the hyphen -> its parts
  const idsByName = new Map(); // name, written as one word -> numbers of the entries

  function prepare() {
    if (index) return;
    index = new MiniSearch({ fields: Object.keys(PLACES), ...ready });
    phrases = new MiniSearch({ fields: ["words"], storeFields: ["entry", "words", "isList", "weight"], ...ready });
    const documents = [];
    index.addAll(
      entries.map(([group, , heading, text, , body, also], id) => {
        const title = heading.replace(CAN, "");
        const names = [...new Set([title, title.split("::").pop()])];
        for (const name of names) if (name === title || pieces(name).length > 1) listIn(idsByName, same(name)).push(id);
        for (const [word] of `${title} ${also} ${text} ${body}`.matchAll(COMPOUND)) compounds.set(stem(same(word)), stems(word));
        const typed = also.split(",").map(stems);
        const addPhrase = (words, isList) =>
          words.length && documents.push({ id: documents.length, entry: id, words: [...new Set(words)], isList });
        titlePhrases(group, title, text, names).forEach((phrase) => addPhrase(stems(phrase), false));
        typed.forEach((words) => addPhrase(words, words.length > LONG));
        const fields = {
          title: [...stems(title), ...names.map((name) => stem(same(name)))], // wheelcontroller, quickstart
          phrases: typed.filter(({ length }) => length <= LONG).flat(),
          lists: typed.filter(({ length }) => length > LONG).flat(),
          body: stems(`${text} ${body}`),
        };
        for (const word of new Set(Object.values(fields).flat())) counts.set(word, (counts.get(word) || 0) + 1);
        return { id, ...fields };
      }),
    );
    phrases.addAll(documents.map((phrase) => ({ ...phrase, weight: sum(phrase.words.map(rarity)) })));
    spellings = new MiniSearch({ fields: ["words"], ...ready });
    const words = [...stemOf].filter(([word, own]) => counts.has(own) && !/\p{N}/u.test(word));
    spellings.add({ id: 0, words: words.map(([word]) => word) });
  }
  /* Returns the phrases that are made from the title of an entry. If the title has parentheses, the words before them
     and the words in them are also phrases. */
  function titlePhrases(group, title, text, names) {
    const isPart = PARTS.has(group) && title !== text;
    const parts = (title.match(/^(.*)\((.*)\)/) || []).slice(1).flatMap((part) => part.split(/,| and /));
    return [...(isPart ? [`${title} ${text}`] : names), ...parts, ...(TITLED.has(group) ? [text] : [])];
  }
  const rarity = (word) => Math.log(1 + entries.length / ((counts.get(word) || 0) + COMMON));

  /* Returns the words of the index that a typed word can mean, each with its weight. If the typed word is in the
     index, it means only itself. Otherwise it means the words that begin with it. If there are none, it means the
     words that differ by the smallest number of typing errors. */
  const typedAs = new Map(); // stem of a typed word -> this word
  const kept = new Map();
  const meanings = (word) => kept.get(typedAs.get(word)) || kept.set(typedAs.get(word), meant(word)).get(typedAs.get(word));
  function meant(word) {
    if (counts.has(word) || compounds.has(word) || groups.flat(2).includes(word)) return [[word, 1]];
    const typed = typedAs.get(word);
    const like = (options) => spellings.search(typed, { ...exactly, ...options }).flatMap(({ terms }) => terms.map(stem));
    const frequent = (words, most) => [...new Set(words)].sort((a, b) => counts.get(b) - counts.get(a)).slice(0, most);
    const longer = frequent(like({ prefix: true }), 8);
    if (longer.length) return longer.map((other) => [other, BEGUN]);
    for (const fuzzy of [1, 2]) {
      if (typed.length < LENGTHS[fuzzy]) break;
      const near = frequent([...exchanged(typed), ...like({ fuzzy })], 3);
      if (near.length) return near.map((other, i) => [other, i || fuzzy > 1 ? BEGUN : CORRECTED]);
    }
    return [[word, 1]];
  }
  /* Returns the words of the index that differ from a typed word by an exchange of two neighbouring letters. */
  const exchanged = (typed) =>
    [...typed]
      .slice(1)
      .map((letter, i) => stem(typed.slice(0, i) + letter + typed[i] + typed.slice(i + 2)))
      .filter((other) => counts.has(other));

  /* Returns the words of a query. A term of several words (safe state) is one element. Each element has a list of
     alternatives; an alternative is a list of words and a weight. */
  const equal = (one, other) => one.join(" ") === other.join(" ");
  function wantedIn(words) {
    const found = [];
    for (let i = 0; i < words.length; ) {
      const isTerm = (own) => groups.some((group) => group.some((one) => equal(one, own)));
      const most = [3, 2].find((n) => i + n <= words.length && isTerm(words.slice(i, i + n))) || 1;
      const own = words.slice(i, i + most);
      const alike = groups.filter((group) => group.some((one) => equal(one, own))).flat();
      const others = alike.filter((one) => !equal(one, own)).map((one) => [one, ALIKE]);
      const read = most > 1 ? [[own, 1]] : meanings(own[0]).map(([word, weight]) => [[word], weight]);
      const parts = most === 1 && compounds.has(own[0]) ? [[compounds.get(own[0]), CORRECTED]] : [];
      found.push({ own, alternatives: [...read, ...others, ...parts] });
      i += most;
    }
    return found;
  }
  /* Returns the query for MiniSearch. It matches an entry that contains all words of at least one alternative. */
  function asQuery(wanted) {
    const lists = wanted.flatMap(({ alternatives }) => alternatives.map(([words]) => words));
    const different = [...new Map(lists.map((words) => [words.join(" "), words])).values()];
    return { ...exactly, combineWith: "OR", queries: different.map((words) => ({ combineWith: "AND", queries: words })) };
  }
  /* Returns a function that computes the share of the query that a phrase or an entry contains. A rare word has more
     weight than a frequent word. terms: the words that were found in the phrase or entry; valueOf: returns the weight
     of a word by the field that contains it */
  function shareIn(wanted) {
    const single = new Map(); // alternative of one word -> pairs: position in wanted, weight
    const several = []; // the alternatives that have several words
    wanted.forEach(({ alternatives }, i) => {
      for (const [words, weight] of alternatives)
        if (words.length === 1) listIn(single, words[0]).push([i, weight]);
        else several.push([i, weight, words]);
    });
    return (terms, valueOf) => {
      const best = wanted.map(() => 0);
      for (const term of terms)
        for (const [i, weight] of single.get(term) || []) best[i] = Math.max(best[i], weight * valueOf(term));
      for (const [i, weight, words] of several)
        if (weight > best[i] && words.every((word) => terms.includes(word)))
          best[i] = Math.max(best[i], weight * Math.min(...words.map(valueOf)));
      return sum(wanted.map(({ share }, i) => share * best[i]));
    };
  }

  /* Returns a map from each entry with a matching phrase to the score of its best phrase. The score combines two
     shares: the share of the query that the phrase contains, and the share of the phrase that the query contains. */
  function nearest(wanted, query, shareOf) {
    const best = new Map();
    const queryWords = new Set(wanted.flatMap(({ alternatives }) => alternatives.flatMap(([words]) => words)));
    for (const { entry, words, isList, weight, terms } of phrases.search(query)) {
      const share = shareOf(terms, () => 1);
      const used = isList ? MIDDLE : sum(words.filter((word) => queryWords.has(word)).map(rarity)) / weight;
      const isEqual = Math.min(share, used) > 0.999;
      best.set(entry, Math.max(best.get(entry) || 0, share * used ** CLOSE + (isEqual ? EQUAL : 0)));
    }
    return best;
  }

  /* Returns true if a query quotes a message. Most words of the query must be in the message, in the same order. The
     other words can be values, such as file names, that the message contained. */
  function isQuoted(message, query) {
    let lengths = message.map(() => 0); // for each word of the message: length of the longest common sequence up to this word
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

  /* Returns the numbers of the entries whose name is the whole query, or whose id is in the query. */
  function namedIn(text, all) {
    const numbered = text.match(NUMBERED);
    const written = [all.join(""), ...(text.match(IDENTIFIER) || []).map(same), ...(numbered ? [`fr${numbered[1]}`] : [])];
    const isSpaced = /\s/.test(text.trim());
    const isName = ([group]) => !UNNAMED.has(group) && !(isSpaced && WRITTEN.has(group));
    return new Set(written.flatMap((name) => idsByName.get(name) || []).filter((id) => isName(entries[id])));
  }

  /* Returns the entries that match a text, the best match first. */
  function find(text) {
    prepare();
    const all = pieces(text.replace(MAY, "")); // "can I": the CAN bus is not meant
    const words = large(all).map(stem);
    large(all).forEach((word) => typedAs.set(stem(word), word));
    if (!words.length) return [];
    const wanted = wantedIn(words);
    const meantWords = new Set(words.flatMap((word) => meanings(word).map(([other]) => other)));
    const kinds = kindWords.filter(([names]) => names.some((name) => meantWords.has(name)));
    const asked = new Set([...kinds.flatMap(([, names]) => names), ...(DEFINES.test(text) ? ["Glossary"] : [])]);
    const isOptional = (word) => kinds.some(([names]) => names.includes(meanings(word)[0][0]));
    const weights = wanted.map(({ own }) => Math.max(...own.map(rarity)) * (own.every(isOptional) ? OPTIONAL : 1));
    wanted.forEach((one, i) => (one.share = weights[i] / sum(weights)));
    const query = asQuery(wanted);
    const shareOf = shareIn(wanted);
    const near = nearest(wanted, query, shareOf);
    const exact = namedIn(text, all);
    const matches = index.search(query, { boost: BOOST, boostDocument: weightOf });
    const absent = [...exact].filter((id) => matches.every((hit) => hit.id !== id));
    const most = matches.length ? matches[0].score : 1;
    const hits = [...matches, ...absent.map((id) => ({ id, match: {}, score: 0 }))].map(({ id, match, score: own }) => {
      const [group, , title] = entries[id];
      const terms = Object.keys(match);
      const contained = exact.has(id) ? 1 : shareOf(terms, (term) => PLACES[match[term][0]]); // match[term] lists the fields with the term; the first field has the greatest weight
      const isNamed = group === "Messages" ? isQuoted(pieces(title), all) : exact.has(id);
      const score = PHRASE * (near.get(id) || 0) + WORDS * contained ** WHOLE + (LIBRARY * own) / most;
      const weight = weightOf(id) * (asked.has(group) ? ASKED : 1);
      return { id, terms, unnamed: score * weight, score: score * weight + (isNamed ? NAMED * weightOf(id) : 0) };
    });
    hits.sort((a, b) => b.score - a.score || a.id - b.id);
    const least = LEAST * Math.max(...hits.map(({ unnamed }) => unnamed)); // without NAMED, so that a name does not remove all other hits
    return hits.filter(({ score }) => score >= least).slice(0, MOST);
  }

  /* Returns the hits in groups. The first group is "Best hits". The other hits are in the group of their entry. The
     groups are in the order of their best hit. */
  function grouped(text) {
    const found = new Map();
    const hits = find(text);
    /* A hand-written page has two entries: one with its name, and one with its text. If the entry with the text is a
       hit, the entry with the name is not shown, because the page would be listed twice. */
    const written = new Set(hits.filter(({ id }) => entries[id][0] === "Explanations").map(({ id }) => entries[id][4]));
    const shown = hits.filter(({ id }) => entries[id][0] !== "Pages" || !written.has(entries[id][4]));
    shown.forEach((hit, i) => listIn(found, i < BEST ? "Best hits" : entries[hit.id][0]).push(hit));
    return found;
  }

  window.PortalSearch = { prepare, grouped, pieces };
})();
