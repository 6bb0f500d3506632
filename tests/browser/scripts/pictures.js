// Waits for all pictures; names those that do not come, and those that come in another size than stated.
const done = arguments[arguments.length - 1];
(async () => {
  const complaints = [];
  for (const picture of document.images) picture.loading = "eager";
  for (const picture of document.images) {
    await picture.decode().catch(() => complaints.push(`${picture.src} does not come`));
    const stated = [picture.getAttribute("width"), picture.getAttribute("height")].join("×");
    const own = [picture.naturalWidth, picture.naturalHeight].join("×");
    if (stated !== own) complaints.push(`${picture.src} is ${own}, not ${stated}`);
  }
  done([document.images.length, complaints]);
})();
