// Draws the page's Mermaid diagrams in the colours of the theme, and again when that is changed.
"use strict";

const dark = matchMedia("(prefers-color-scheme: dark)");
const blocks = [...document.querySelectorAll(".diagram")].map((block) => {
  const picture = document.createElement("div");
  picture.className = "drawn-diagram";
  block.replaceWith(picture);
  return { text: block.innerText, picture };
});

async function draw() {
  const chosen = document.body.dataset.theme;
  const isDark = chosen === "dark" || (chosen !== "light" && dark.matches);
  mermaid.initialize({ startOnLoad: false, theme: isDark ? "dark" : "neutral", flowchart: { htmlLabels: false } });
  for (const [number, { text, picture }] of blocks.entries()) {
    picture.innerHTML = (await mermaid.render(`diagram-${number}`, text)).svg;
  }
}

new MutationObserver(draw).observe(document.body, { attributeFilter: ["data-theme"] });
dark.addEventListener("change", draw);
draw();
