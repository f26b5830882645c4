// The connection to the program, which works in a worker (src/page/web/worker.js): mimicx.mjs and the browser page
// (src/page/web) make requests through it.

// Begins the program in a worker of a browser or of Node.
// @param wasm  the program's bytes, or a promise of them
// @param on_told  called with a line about the work, and whether it stays visible
// @return ask(request): the worker's answer, one request after the other, rejected with the program's error;
//     end(reason): ends the worker and rejects its requests with the reason; ended(): whether the worker has ended
export function connect(worker, wasm, on_told) {
  let waiting, over;
  const end = (reason) => {
    over ??= {reason};
    worker.terminate();
    waiting?.fail(over.reason);
  };
  const send = (request) => new Promise((done, fail) => {
    if (over) throw over.reason;
    waiting = {done, fail};
    worker.postMessage(request);
  });
  const hear = ({told, urgent, ended, ...said}) => {
    if (told !== undefined) { try { on_told(told, urgent); } catch (error) { end(error); } }
    else if (ended) end(new Error(said.answer.error));
    else if (said.answer?.error !== undefined) waiting.fail(new Error(said.answer.error));
    else waiting.done(said);
  };
  if (worker.on) worker.on('message', hear).on('error', end);
  else Object.assign(worker, {onmessage: ({data}) => hear(data),
                              onerror: ({message}) => end(new Error(message || 'the worker cannot be loaded'))});
  let last = Promise.resolve(wasm).then((bytes) => send({ask: 'begin', wasm: bytes})).catch(end);
  const ask = (request) => {
    const answer = last.then(() => send(request));
    last = answer.catch(() => {});
    return answer;
  };
  return {ask, end, ended: () => over !== undefined};
}
