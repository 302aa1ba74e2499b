# What only the report needs: tables as pages, where the results come from, and the numbers in short.


rule tabulate_key_numbers:
    input:
        "results/tables/trajectories.csv",
        "results/tables/regimes.csv",
        "results/tables/reconstruction.csv",
        "results/tables/baselines.csv",
        "results/tables/lags.csv",
    output:
        "results/tables/key_numbers.csv",
    log:
        "results/logs/tabulate_key_numbers.log",
    params:
        code=code_of("tabulate_key_numbers"),
        settings=as_json(STUDY.key_numbers_settings),
    shell:
        "sedfiber tabulate_key_numbers {input} --settings {params.settings:q} -o {output} > {log} 2>&1"


rule show_table:
    input:
        table="results/tables/{table}.csv",
    output:
        report(
            "results/report/{table}.html",
            caption="../report/caption.rst",
            category=shown_in,
            labels={"table": "{table}"},
        ),
    log:
        "results/logs/show_table/{table}.log",
    group:
        "pages"
    params:
        code=code_of("show_table"),
        caption=lambda wildcards, output: TABLES[wildcards.table],
    shell:
        "sedfiber show_table {input.table} -o {output} > {log} 2>&1"


rule show_manifest:
    input:
        manifest="results/manifest.json",
    output:
        report(
            "results/report/provenance/manifest.html",
            caption="../report/provenance.rst",
            category=PROVENANCE,
            labels={"table": "provenance"},
        ),
    log:
        "results/logs/show_manifest.log",
    params:
        code=code_of("show_manifest"),
    shell:
        "sedfiber show_manifest {input.manifest} -o {output} > {log} 2>&1"
