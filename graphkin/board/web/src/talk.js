// Questions to Python and their answers, over a socket of the page or through the notebook.

/** Asks over sockets: one for what a hand waits for, one for long work.  `heard(open)` is told of the connection. */
export function overSockets(address, heard) {
  const lines = {};
  const line = (kind) => (lines[kind] ??= socketLine(address, (open) => kind === "quick" && heard(open)));
  line("quick");
  return (question, long = false) => line(long ? "long" : "quick")(question);
}

function socketLine(address, heard) {
  let socket = null;
  let number = 0;
  let wait = 250;
  const waiting = new Map(); // id -> { question, resolve }
  const connect = () => {
    socket = new WebSocket(address);
    socket.onopen = () => {
      wait = 250;
      heard(true);
      for (const { question } of waiting.values()) socket.send(JSON.stringify(question));
    };
    socket.onmessage = (event) => {
      const told = JSON.parse(event.data);
      waiting.get(told.id)?.resolve(told);
      waiting.delete(told.id);
    };
    socket.onclose = () => {
      heard(false);
      setTimeout(connect, wait);
      wait = Math.min(wait * 2, 5000);
    };
  };
  connect();
  return (question) =>
    new Promise((resolve) => {
      const numbered = { ...question, id: ++number };
      waiting.set(number, { question: numbered, resolve });
      if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(numbered));
    });
}

/** Asks through the widget of a notebook. */
export function overWidget(model) {
  let number = 0;
  const waiting = new Map();
  model.on("msg:custom", (told) => {
    waiting.get(told.id)?.(told);
    waiting.delete(told.id);
  });
  return (question) =>
    new Promise((resolve) => {
      waiting.set(++number, resolve);
      model.send({ ...question, id: number });
    });
}

/** Only the newest question waits while one is answered; those between are dropped. */
export function newestOnly(ask, told) {
  let busy = false;
  let next = null;
  const go = async () => {
    if (busy || !next) return;
    const [question, about] = next;
    next = null;
    busy = true;
    const answer = await ask(question);
    busy = false;
    told(answer, about, next !== null);
    go();
  };
  return (question, about) => {
    next = [question, about];
    go();
  };
}
