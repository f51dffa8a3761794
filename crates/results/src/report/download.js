"use strict";
for (const button of document.querySelectorAll("figure button")) {
  button.hidden = false;
  button.addEventListener("click", () => {
    const drawing = button.closest("figure").querySelector("svg");
    const text = new XMLSerializer().serializeToString(drawing);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
    link.download = button.dataset.file;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  });
}
