-- SPDX-License-Identifier: Apache-2.0
-- Neovim as a client of the language server, without a display: opens a document, waits for a message, asks for hover, completion, symbols and a
-- definition, applies a quick fix and formats. Prints what comes back, a line each. Environment: MXGEN, DOCUMENT.
local function say(what, text) io.stdout:write(what, ": ", text, "\n") end
local path = vim.env.DOCUMENT
vim.cmd("edit " .. path)
local client = vim.lsp.start_client({ name = "mxgen", cmd = { vim.env.MXGEN, "lsp" }, root_dir = vim.fn.fnamemodify(path, ":h") })
vim.lsp.buf_attach_client(0, client)
local function ask(method, line, character, more)
  local params = vim.tbl_extend("force", { textDocument = vim.lsp.util.make_text_document_params(),
    position = { line = line, character = character } }, more or {})
  local answers = vim.lsp.buf_request_sync(0, method, params, 10000) or {}
  return answers[client] and answers[client].result
end
vim.wait(10000, function() return #vim.diagnostic.get(0) > 0 end, 10)
local found = vim.diagnostic.get(0)[1]
say("message", found.code .. " in line " .. found.lnum + 1)
say("hover", vim.split(ask("textDocument/hover", 2, 5).contents.value, "\n")[1])
local column = select(2, vim.api.nvim_buf_get_lines(0, 3, 4, true)[1]:find('nodename="', 1, true))
say("completion", ask("textDocument/completion", 3, column).items[1].label)
say("symbols", table.concat(vim.tbl_map(function(item) return item.name end, ask("textDocument/documentSymbol", 0, 0)), " "))
say("definition", "line " .. ask("textDocument/definition", 3, column).range.start.line + 1)
local place = { line = found.lnum, character = found.col }
local actions = ask("textDocument/codeAction", 0, 0, { range = { start = place, ["end"] = place }, context = { diagnostics = {} } })
say("action", actions[1].title)
vim.lsp.util.apply_workspace_edit(actions[1].edit, "utf-16")
vim.wait(10000, function() return #vim.diagnostic.get(0) == 0 end, 10)
say("messages after it", tostring(#vim.diagnostic.get(0)))
vim.lsp.buf.formatting_sync(nil, 10000)
say("formatted", vim.api.nvim_buf_get_lines(0, 4, 5, true)[1])
vim.lsp.stop_client(client)
vim.cmd("qa!")
