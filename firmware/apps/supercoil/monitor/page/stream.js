// What the server pushes, as events: "batch" (detail: the batch), "open", "lost" (detail: why), "found", "closed".

import { token } from "./server.js";

export class Stream extends EventTarget {
  open() {
    const url = new URL("/api/stream", location.href);
    // Missed data is requested from the history instead.
    url.searchParams.set("resume", "no");
    if (token) url.searchParams.set("token", token);
    if ("SharedWorker" in window) {
      // Pages with another token may see other data, and have their own worker.
      const { port } = new SharedWorker("/stream_worker.js", { name: token });
      port.onmessage = ({ data }) => this.#take(data);
      port.postMessage({ url: url.href });
    } else {
      this.#open_alone(url);
    }
  }

  #open_alone(url) {
    const source = new EventSource(url);
    source.onopen = () => this.#take({ kind: "open" });
    source.onmessage = (event) => this.#take({ kind: "batch", data: event.data });
    source.addEventListener("lost", (event) => this.#take({ kind: "lost", data: event.data }));
    source.addEventListener("found", () => this.#take({ kind: "found" }));
    source.onerror = () => {
      this.#take({ kind: "closed" });
      if (source.readyState === EventSource.CLOSED) setTimeout(() => this.#open_alone(url), 1000);
    };
  }

  #take({ kind, data }) {
    const detail = data === undefined ? null : JSON.parse(data);
    this.dispatchEvent(new CustomEvent(kind, { detail }));
  }
}
