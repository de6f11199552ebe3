// Enhancements only: search, enlarged figures, opened details. Every page is complete without this file.
(() => {
  const rows = [...document.querySelectorAll(".row")];
  const query = document.getElementById("q");
  const hits = document.getElementById("hits");
  if (query) {
    query.closest(".search").hidden = false;
    query.closest("form")?.addEventListener("submit", (event) => event.preventDefault());
    const texts = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
    const counted = rows.filter((row) => row.tagName === "TR");
    query.addEventListener("input", () => {
      const wanted = query.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const row of rows) row.classList.toggle("unmatched", !wanted.every((word) => texts.get(row).includes(word)));
      const left = counted.filter((row) => !row.classList.contains("unmatched"));
      hits.textContent = wanted.length ? `${left.length} of ${counted.length} claims` : "";
      for (const group of document.querySelectorAll(".claims-of"))
        group.open = wanted.length > 0 && group.querySelector(".row:not(.unmatched)") !== null;
    });
  }

  // A first click shows one verdict alone; further clicks add others; taking away the last one shows all again.
  for (const set of document.querySelectorAll(".filter fieldset")) {
    const boxes = [...set.querySelectorAll("input")];
    set.addEventListener("change", (event) => {
      const others = boxes.filter((box) => box !== event.target);
      if (!event.target.checked && others.every((box) => box.checked)) {
        event.target.checked = true;
        for (const box of others) box.checked = false;
      } else if (boxes.every((box) => !box.checked)) for (const box of boxes) box.checked = true;
    });
  }

  const reveal = () => {
    const target = location.hash.length > 1 && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    if (target.classList.contains("claim")) {
      target.classList.remove("unmatched");
      for (const list of ["verdict", "strength"]) {
        const box = document.querySelector(`input[name="${list}"][value="${target.dataset[list]}"]`);
        if (box) box.checked = true;
      }
      const details = target.querySelector(".readings");
      if (details) details.open = true;
    }
    target.closest("details")?.setAttribute("open", "");
    target.scrollIntoView();
  };
  addEventListener("hashchange", reveal);
  reveal();

  const dialog = document.createElement("dialog");
  if (dialog.showModal) {
    dialog.innerHTML = '<button type="button">Close</button><img alt="">';
    document.body.append(dialog);
    const image = dialog.querySelector("img");
    dialog.addEventListener("click", () => dialog.close());
    for (const link of document.querySelectorAll("a.zoom"))
      link.addEventListener("click", (event) => {
        if (event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        image.src = link.href;
        image.alt = link.querySelector("img").alt;
        dialog.setAttribute("aria-label", image.alt);
        dialog.showModal();
      });
  }

  let closed = [];
  addEventListener("beforeprint", () => {
    closed = [...document.querySelectorAll("details:not([open])")];
    for (const details of closed) details.open = true;
  });
  addEventListener("afterprint", () => { for (const details of closed) details.open = false; });
})();
