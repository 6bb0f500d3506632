// Goes to places of this page, as a link does; names those that are not in view then, and those that are not there at all.
// Chromium follows no more than 200 changes of address in ten seconds, so of many places some are visited.
const [places, done] = arguments;
const visits = 90;
const visible = (place) => {
  const { top, bottom } = document.getElementById(place).getBoundingClientRect();
  const inside = top >= -1 && top < innerHeight && bottom > 0;
  return inside ? null : `${place}: at ${Math.round(top)} px of ${innerHeight} px`;
};
(async () => {
  const lost = places.filter((place) => !document.getElementById(place)).map((place) => `${place}: not there`);
  const there = places.filter((place) => document.getElementById(place));
  const every = Math.max(1, Math.ceil(there.length / visits));
  for (const place of there.filter((_, number) => number % every === 0)) {
    if (decodeURIComponent(location.hash.slice(1)) === place) continue;
    scrollTo(0, 0);
    const followed = new Promise((ready) => addEventListener("hashchange", () => setTimeout(ready), { once: true }));
    location.hash = place;
    // what listens to the change of address has had its turn
    await followed;
    const complaint = visible(place);
    if (complaint) lost.push(complaint);
  }
  done(lost);
})();
