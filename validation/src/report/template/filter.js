// The page is complete without this: it only adds a filter above the verdicts.
(() => {
  const form = document.getElementById("filter");
  const cases = [...document.querySelectorAll("details.verdicts")];
  if (!form || cases.length === 0) return;
  const select = document.createElement("select");
  select.setAttribute("aria-label", "case");
  for (const name of ["", ...cases.map((element) => element.dataset.case)]) {
    select.add(new Option(name || "all cases", name));
  }
  const only = document.createElement("input");
  only.type = "checkbox";
  const label = document.createElement("label");
  label.append(only, " only what fails or drifted");
  form.append(select, label);
  form.hidden = false;
  const apply = () => {
    for (const element of document.querySelectorAll("[data-case]")) {
      const wanted = !select.value || element.dataset.case === select.value;
      element.hidden = !wanted;
      if (wanted && select.value && element.tagName === "DETAILS") element.open = true;
    }
    for (const row of document.querySelectorAll("table.metrics tbody tr")) {
      row.hidden = only.checked && !row.matches(".fail, .known, .drifted");
    }
  };
  form.addEventListener("change", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  // A link to a folded case, or to a row in it, unfolds it; printing unfolds everything.
  const unfold = () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const folded = target && target.closest("details");
    if (!folded) return;
    folded.open = true;
    if (folded !== target) target.scrollIntoView({ block: "center" });
  };
  addEventListener("hashchange", unfold);
  addEventListener("beforeprint", () => document.querySelectorAll("details.verdicts").forEach((d) => { d.open = true; }));
  unfold();
})();
