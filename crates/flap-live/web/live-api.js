// Requests to the server. Each has a number; a newer one of its kind cancels the older one.

class ServerError extends Error {
  constructor(status, { error, help = null, parameter = null }) {
    super(error);
    Object.assign(this, { status, help, parameter });
  }
}

const server = {
  token: new URLSearchParams(location.search).get("token") ?? "",
  page: Array.from(crypto.getRandomValues(new Uint32Array(2)), (part) => part.toString(36)).join(""),
  numbers: {},
  running: {},
  onGone: () => {},
  onBack: () => {},
  isGone: false,

  /** The answer to a request; null if a newer one took its place. Requests of other lanes do not stand in each other's way. */
  async ask(kind, body, lane = "") {
    const queue = kind + lane;
    this.running[queue]?.abort();
    const number = (this.numbers[queue] = (this.numbers[queue] ?? 0) + 1);
    const control = (this.running[queue] = new AbortController());
    try {
      const answer = await fetch(`/api/${kind}`, {
        method: "POST", signal: control.signal,
        headers: { "Content-Type": "application/json", "X-Flap-Token": this.token },
        body: JSON.stringify({ page: this.page + lane, number, ...body }),
      });
      const found = await answer.json();
      if (this.isGone) { this.isGone = false; this.onBack(); }
      if (number !== this.numbers[queue] || answer.status === 409) return null;
      if (!answer.ok) throw new ServerError(answer.status, found);
      return found;
    } catch (error) {
      if (error.name === "AbortError" || number !== this.numbers[queue]) return null;
      if (!(error instanceof ServerError)) this.lost();
      throw error instanceof ServerError ? error : new ServerError(0, { error: "the server does not answer" });
    } finally {
      if (this.running[queue] === control) delete this.running[queue];
    }
  },

  /** The server is gone: asks for it until it is there again. */
  lost() {
    if (this.isGone) return;
    this.isGone = true;
    this.onGone();
    const look = async () => {
      if (!this.isGone) return;
      try {
        const answer = await fetch("/api/save", { method: "POST", headers: { "X-Flap-Token": this.token }, body: JSON.stringify({ kind: "grid" }) });
        this.isGone = false;
        if (answer.status === 401) banner.say("server", "Another server answers now: open the address that it printed.");
        else this.onBack();
      } catch { setTimeout(look, 1000); }
    };
    setTimeout(look, 1000);
  },
};
