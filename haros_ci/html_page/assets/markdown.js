// Pages of rules, as their Markdown says it: headings, paragraphs, lists, tables, code. Links are shown as their words.
function inline(source) {
  const made = [];
  const pattern = /`([^`]{1,500})`|\*\*([^*]{1,500})\*\*|\[([^\]]{1,300})\]\([^)\s]{1,500}\)/g;
  let at = 0;
  for (const match of source.matchAll(pattern)) {
    made.push(source.slice(at, match.index));
    made.push(match[1] !== undefined ? h("code", null, match[1]) : match[2] !== undefined ? h("strong", null, match[2]) : match[3]);
    at = match.index + match[0].length;
  }
  return [...made, source.slice(at)];
}

function markdown(source) {
  const made = [];
  const all = source.split("\n");
  let at = 0;
  const until = (test) => {
    const found = [];
    while (at < all.length && test(all[at])) found.push(all[at++]);
    return found;
  };
  while (at < all.length) {
    const line = all[at];
    const heading = /^(#{1,4})\s+(.*)$/.exec(line);
    if (line.startsWith("```")) {
      at++;
      made.push(h("pre", { tabindex: "0" }, until((one) => !one.startsWith("```")).join("\n")));
      at++;
    } else if (line.startsWith("    ") && line.trim()) {
      made.push(h("pre", { tabindex: "0" }, until((one) => one.startsWith("    ") || !one.trim()).map((one) => one.slice(4)).join("\n").trimEnd()));
    } else if (heading) {
      at++;
      made.push(h(heading[1].length < 3 ? "h4" : "h5", null, inline(heading[2])));
    } else if (/^\s*[-*] /.test(line)) {
      const items = [];
      for (const one of until((each) => /^\s*[-*] /.test(each) || /^\s{2,}\S/.test(each)))
        if (/^\s*[-*] /.test(one)) items.push(one.replace(/^\s*[-*] /, ""));
        else items[items.length - 1] += ` ${one.trim()}`;
      made.push(h("ul", null, items.map((one) => h("li", null, inline(one)))));
    } else if (line.startsWith("|")) {
      const rows = until((one) => one.startsWith("|")).map((one) => one.replace(/^\|/, "").replace(/\|\s*$/, "").split("|").map((cell) => cell.trim()));
      const isRule = rows.length > 1 && rows[1].every((cell) => /^:?-+:?$/.test(cell));
      made.push(smallTable(rows[0].map(inline), rows.slice(isRule ? 2 : 1).map((row) => row.map(inline)), "table"));
    } else if (line.trim()) {
      const first = at++;
      until((one) => one.trim() && !/^(#|```|\||\s*[-*] )/.test(one));
      made.push(h("p", null, inline(all.slice(first, at).join(" "))));
    } else at++;
  }
  return made;
}
