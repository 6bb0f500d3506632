// The pages are complete without this: it adds search, filters and sorting above tables, and unfolds what is linked or printed.
(() => {
  const text = (row, selector) => row.querySelector(selector)?.textContent.replaceAll("\u00a0", " ").trim() ?? "";
  const facets = { verdict: ".verdict > span, .fate > span", kind: ".kind", case: "td.case" };

  const filtered = (form) => {
    const rows = [...document.querySelectorAll(form.dataset.rows)];
    if (rows.length < 2) return null;
    const search = document.createElement("input");
    Object.assign(search, { type: "search", placeholder: "search: press /", name: "search" });
    search.setAttribute("aria-label", "search");
    form.append(search);
    const selects = [];
    for (const [name, selector] of Object.entries(facets)) {
      const values = [...new Set(rows.map((row) => text(row, selector)))].filter(Boolean);
      if (values.length < 2) continue;
      const select = document.createElement("select");
      select.name = name;
      select.setAttribute("aria-label", name);
      for (const value of ["", ...values]) select.add(new Option(value || `any ${name}`, value));
      if (name === "verdict" && rows.some((row) => row.matches(".fail, .expected, .has-moved"))) {
        select.add(new Option("fails or moved", "!"), 1);
      }
      selects.push([select, selector]);
      form.append(select);
    }
    const found = document.createElement("output");
    form.append(found);
    const words = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
    const wanted = (row, select, selector) => select.value === ""
      || (select.value === "!" ? row.matches(".fail, .expected, .has-moved") : text(row, selector) === select.value);
    const apply = () => {
      const parts = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const row of rows) {
        row.hidden = !(parts.every((part) => words.get(row).includes(part))
          && selects.every(([select, selector]) => wanted(row, select, selector)));
        shown += row.hidden ? 0 : 1;
      }
      for (const table of new Set(rows.map((row) => row.closest("table")))) {
        const empty = rows.every((row) => row.hidden || row.closest("table") !== table);
        (table.closest("article") ?? table).hidden = empty;
        table.classList.toggle("reordered", shown < rows.length || table.classList.contains("sorted"));
      }
      found.textContent = shown === rows.length ? `${shown} rows` : shown ? `${shown} of ${rows.length} rows` : "no row matches";
    };
    form.addEventListener("input", apply);
    form.addEventListener("submit", (event) => event.preventDefault());
    search.addEventListener("keydown", (event) => {
      if (event.key === "Escape") { search.value = ""; search.blur(); apply(); }
    });
    form.hidden = false;
    apply();
    return { search, show: () => { form.reset(); apply(); } };
  };

  const sortable = (form) => {
    const table = document.getElementById(form.dataset.table);
    if (!table) return;
    const rows = [...table.tBodies];
    const heads = [...table.tHead.rows[0].cells];
    const chooser = document.createElement("select");
    chooser.name = "sort";
    chooser.setAttribute("aria-label", "sort by");
    chooser.add(new Option("as listed", ""));
    const key = (row, head) => {
      if (!head.dataset.key) return text(row, `tr > :nth-child(${head.cellIndex + 1})`);
      const number = parseFloat(row.dataset[head.dataset.key]);
      // what has no number comes last, whichever way
      return Number.isNaN(number) ? null : head.dataset.key === "change" ? -number : number;
    };
    const sort = (chosen, turned) => {
      const order = [...rows];
      if (chosen) {
        const keys = new Map(rows.map((row) => [row, key(row, chosen)]));
        order.sort((one, other) => {
          const [a, b] = [keys.get(one), keys.get(other)];
          if (a === null || b === null) return (a === null) - (b === null);
          const difference = typeof a === "number" ? a - b : a.localeCompare(b, "en", { numeric: true });
          return turned ? -difference : difference;
        });
      }
      for (const head of heads) head.removeAttribute("aria-sort");
      chosen?.setAttribute("aria-sort", turned ? "descending" : "ascending");
      chooser.value = chosen ? String(heads.indexOf(chosen)) : "";
      table.classList.toggle("sorted", Boolean(chosen));
      table.classList.toggle("reordered", Boolean(chosen) || rows.some((row) => row.hidden));
      table.append(...order);
    };
    for (const [place, head] of heads.entries()) {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => sort(head, head.getAttribute("aria-sort") === "ascending"));
      chooser.add(new Option(`sort by ${button.textContent}`, String(place)));
    }
    chooser.addEventListener("change", () => sort(heads[chooser.value], false));
    form.insertBefore(chooser, form.querySelector("output"));
  };

  const filters = [...document.querySelectorAll("form.filter")].map((form) => {
    const filter = filtered(form);
    if (filter && form.dataset.table) sortable(form);
    return filter;
  }).filter(Boolean);
  addEventListener("keydown", (event) => {
    const typing = event.target.closest?.("input, select, textarea");
    if (event.key !== "/" || typing || event.ctrlKey || event.metaKey || event.altKey || filters.length === 0) return;
    event.preventDefault();
    const folded = filters[0].search.closest("details");
    if (folded) folded.open = true;
    filters[0].search.focus();
    filters[0].search.scrollIntoView({ block: "nearest" });
  });
  // A link to a row that a filter hides, or into something folded, shows it.
  const reveal = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    const folded = target.closest("details");
    if (folded) folded.open = true;
    if (target.closest("[hidden]")) for (const filter of filters) filter.show();
    target.scrollIntoView({ block: target.matches("tbody, tr") ? "center" : "start" });
  };
  addEventListener("hashchange", reveal);
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((folded) => { folded.open = true; }));
  reveal();
})();
