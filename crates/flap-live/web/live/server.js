// @ts-check
// Requests to the server. A newer request of a kind closes the connection of the older one, which cancels it.

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
  const control = new AbortController();
  running.set(queue, control);
  try {
    const answer = await fetch(`/api/${kind}`, {
      method: "POST",
      signal: control.signal,
      headers: { "Content-Type": "application/json", "X-Flap-Token": token },
      body: JSON.stringify(body),
    });
    const found = await answer.json();
    restore();
    if (control.signal.aborted) return null;
    if (!answer.ok) throw new ServerError(answer.status, found);
    return found;
  } catch (error) {
    if (error instanceof Error && error.name === "AbortError") return null;
    if (error instanceof ServerError) throw error;
    waitForServer();
    throw new ServerError(0, { error: "the server does not answer" });
  } finally {
    if (running.get(queue) === control) running.delete(queue);
  }
};
