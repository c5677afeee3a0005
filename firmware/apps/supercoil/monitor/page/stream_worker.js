// One event stream for all pages of this browser, which allows only six connections to a server.
// A classic script, so that it runs as a SharedWorker everywhere.

const pages = [];
let source = null;
let lost = null; // the message, while the source is lost

function post(message) {
  if (message.kind === "lost") lost = message;
  if (message.kind === "found" || message.kind === "open") lost = null;
  for (const page of pages) page.postMessage(message);
}

function open(url) {
  source = new EventSource(url);
  source.onopen = () => post({ kind: "open" });
  source.onmessage = (event) => post({ kind: "batch", data: event.data });
  source.addEventListener("lost", (event) => post({ kind: "lost", data: event.data }));
  source.addEventListener("found", () => post({ kind: "found" }));
  source.onerror = () => {
    post({ kind: "closed" });
    // The browser does not reopen a refused stream (too many of them).
    if (source.readyState === EventSource.CLOSED) setTimeout(open, 1000, url);
  };
}

onconnect = (event) => {
  const [page] = event.ports;
  pages.push(page);
  page.onmessage = ({ data }) => {
    if (!source) return open(data.url);
    page.postMessage({ kind: source.readyState === EventSource.OPEN ? "open" : "closed" });
    if (lost) page.postMessage(lost);
  };
};
