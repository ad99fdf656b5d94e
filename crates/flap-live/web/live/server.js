// @ts-check
// Requests to the server. Each has a number, and a newer request of its kind cancels the older one.

/** Time between two attempts to reach a server that does not answer, in milliseconds. */
const RETRY = 1000;

export class ServerError extends Error {
  /**
   * @param {number} status the HTTP status; 0 if the server does not answer
   * @param {{ error: string, help?: string | null, parameter?: string | null }} answer
   */
  constructor(status, { error, help = null, parameter = null }) {
    super(error);
    this.status = status;
    this.help = help;
    this.parameter = parameter;
  }

  /** The message with the advice. */
  text(separator = ". ") {
    return [this.message, this.help].filter(Boolean).join(separator);
  }
}

const token = new URLSearchParams(location.search).get("token") ?? "";
const pageName = Array.from(crypto.getRandomValues(new Uint32Array(2)), (part) => part.toString(36)).join("");
/** @type {Map<string, number>} */
const numbers = new Map();
/** @type {Map<string, AbortController>} */
const running = new Map();

/** The state of the connection: true if the server answers, and callbacks for changes. */
export const connection = {
  isLost: false,
  onLost: () => {},
  onRestored: () => {},
  /** Called if another server with another token answers. */
  onReplaced: () => {},
};

const restore = () => {
  if (!connection.isLost) return;
  connection.isLost = false;
  connection.onRestored();
};

/** Tries to reach the server until it answers. */
const waitForServer = () => {
  if (connection.isLost) return;
  connection.isLost = true;
  connection.onLost();
  const attempt = async () => {
    if (!connection.isLost) return;
    try {
      const body = JSON.stringify({ kind: "grid" });
      const answer = await fetch("/api/save", { method: "POST", headers: { "X-Flap-Token": token }, body });
      if (answer.status === 401) {
        connection.isLost = false;
        connection.onReplaced();
      } else restore();
    } catch {
      setTimeout(attempt, RETRY);
    }
  };
  setTimeout(attempt, RETRY);
};

/**
 * The answer to a request; null if a newer request has replaced it. Requests of different lanes do not cancel each
 * other.
 *
 * @param {"family" | "hysteresis" | "point" | "motion" | "save"} kind
 * @param {object} body
 * @param {string} lane
 * @returns {Promise<any>}
 */
export const request = async (kind, body, lane = "") => {
  const queue = kind + lane;
  running.get(queue)?.abort();
  const number = (numbers.get(queue) ?? 0) + 1;
  const control = new AbortController();
  numbers.set(queue, number);
  running.set(queue, control);
  try {
    const answer = await fetch(`/api/${kind}`, {
      method: "POST",
      signal: control.signal,
      headers: { "Content-Type": "application/json", "X-Flap-Token": token },
      body: JSON.stringify({ page: pageName + lane, number, ...body }),
    });
    const found = await answer.json();
    restore();
    if (number !== numbers.get(queue) || answer.status === 409) return null;
    if (!answer.ok) throw new ServerError(answer.status, found);
    return found;
  } catch (error) {
    if (number !== numbers.get(queue) || (error instanceof Error && error.name === "AbortError")) return null;
    if (error instanceof ServerError) throw error;
    waitForServer();
    throw new ServerError(0, { error: "the server does not answer" });
  } finally {
    if (running.get(queue) === control) running.delete(queue);
  }
};
