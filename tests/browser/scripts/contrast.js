// Names texts whose contrast with what lies behind them is below 4.5, as WCAG 2 counts it.
const channels = (colour) => (colour.match(/[\d.]+/g) ?? []).map(Number);
const light = (colour) => {
  const [red, green, blue] = channels(colour).map((value) => {
    const share = value / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
};
const behind = (element) => {
  for (let around = element; around; around = around.parentElement) {
    const colour = getComputedStyle(around).backgroundColor;
    if (channels(colour)[3] !== 0) return colour;
  }
  return "rgb(255, 255, 255)";
};
const worst = new Map();
for (const element of document.querySelectorAll("body *")) {
  const says = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
  const look = getComputedStyle(element);
  if (!says || !element.checkVisibility() || look.opacity !== "1" || element.matches("script, option")) continue;
  const [front, back] = [light(look.color), light(behind(element))];
  const contrast = (Math.max(front, back) + 0.05) / (Math.min(front, back) + 0.05);
  if (contrast < 4.5) worst.set(`${element.tagName}.${element.className}: ${contrast.toFixed(2)}`, true);
}
return [light(getComputedStyle(document.body).backgroundColor), [...worst.keys()].slice(0, 10)];
