// The page's end of the console's WebSocket: connects again by itself, says that the page is there, and says
// an emergency stop until it is confirmed.

const alive_ms = 300;
const estop_again_ms = 20;
const reconnect_ms = 500;
const stale_ms = 1500; // states come four times a second

export class Link extends EventTarget {
  #socket = null;
  #heard_ms = performance.now();
  #estop_timer = 0;
  #next_id = 1;
  page = -1;
  open = false;
  /** The page is drawn, and answers its operator: from now on it says that it is there. */
  ready = false;

  constructor(url) {
    super();
    this.url = url;
    this.#connect();
    setInterval(() => this.#keepAlive(), alive_ms);
  }

  /** What is not heard any more is not shown as if it were now. */
  get stale() {
    return !this.open || performance.now() - this.#heard_ms > stale_ms;
  }

  send(message) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  /** @return the number that its replies carry. */
  request(command, parameters) {
    const id = this.#next_id++;
    if (!this.send({ type: "request", id, command, parameters })) {
      this.#emit("reply", { id, command, outcome: "not sent", reason: "there is no connection", over: true });
    }
    return id;
  }

  /** At once, and again until the server says that no drive has power; also over a connection that is made anew. */
  estop() {
    this.send({ type: "estop" });
    if (this.#estop_timer) return;
    this.#estop_timer = setInterval(() => this.send({ type: "estop" }), estop_again_ms);
    this.#emit("estop", { state: "asked" });
  }

  #connect() {
    const socket = new WebSocket(this.url, "sprung.v1");
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    socket.onopen = () => {
      this.open = true;
      this.#emit("open", {});
    };
    socket.onmessage = (event) => this.#take(event.data);
    socket.onclose = (event) => {
      this.open = false;
      this.#emit("closed", { reason: event.reason });
      setTimeout(() => this.#connect(), reconnect_ms);
    };
  }

  #take(data) {
    if (typeof data !== "string") return this.#emit("frame", data);
    const message = JSON.parse(data);
    if (message.type === "state") this.#heard_ms = performance.now();
    if (message.type === "hello") this.page = message.page;
    if (message.type === "estop" && message.state === "confirmed") {
      clearInterval(this.#estop_timer);
      this.#estop_timer = 0;
    }
    this.#emit(message.type, message);
  }

  #keepAlive() {
    // A socket of a laptop that slept looks open for minutes: the server has closed its end long ago.
    if (this.open && performance.now() - this.#heard_ms > 4 * stale_ms) this.#socket.close();
    if (this.ready) this.send({ type: "alive" });
  }

  #emit(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
