// Names what sticks out of the window and cannot be scrolled to within a box of its own.
const complaints = [];
const width = document.documentElement.clientWidth;
if (document.documentElement.scrollWidth > width) complaints.push(`the page is ${document.documentElement.scrollWidth} px wide`);
for (const element of document.querySelectorAll("body *")) {
  const box = element.getBoundingClientRect();
  if (box.width === 0 || box.right <= width + 1 || element.ownerSVGElement) continue;
  let around = element.parentElement;
  while (around && !["auto", "scroll", "hidden"].includes(getComputedStyle(around).overflowX)) around = around.parentElement;
  if (!around || around.getBoundingClientRect().right > width + 1) {
    complaints.push(`${element.tagName}.${element.className} ends at ${Math.round(box.right)} px: ${element.textContent.slice(0, 60)}`);
  }
}
return [width, complaints.slice(0, 10)];
